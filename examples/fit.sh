#!/bin/sh
# Which model for a gonioreflectometer file, with which parameters, and how sure. Run from the project's root.
set -eu
brdfguide inspect examples/rough_plastic.csv
brdfguide fit examples/rough_plastic.csv --plot "${TMPDIR:-/tmp}/fit.png" --report "${TMPDIR:-/tmp}/fit.html"
brdfguide fit examples/rough_plastic.csv --models lambertian+ggx,lambertian+he-torrance --json --no-timing > "${TMPDIR:-/tmp}/fit.json"
brdfguide evaluate --fit "${TMPDIR:-/tmp}/fit.json" --theta-i 75 --theta-r 60:80:5
