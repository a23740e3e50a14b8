#!/bin/sh
# What to use for a surface that nobody measured: from what one can see. Run from the project's root.
set -eu
cat > "${TMPDIR:-/tmp}/mug.yaml" <<'YAML'
name: coffee mug
kind: dielectric
composition: porcelain
appearance: solid colour
finish: high gloss
diffuse_reflectance: [0.05, 0.10, 0.30]
YAML
brdfguide recommend "${TMPDIR:-/tmp}/mug.yaml" --explain
brdfguide recommend office-paper
brdfguide gloss --at-60 45 --n 1.5
brdfguide index --f0 0.04
