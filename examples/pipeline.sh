#!/bin/sh
# Answers for scripts: one number in a blink, many in one process, JSON for programs. Run from the project's root.
set -eu
brdfguide roughness --angle 75
printf '60\n75\n80\n' | brdfguide roughness --batch -
brdfguide roughness --angle 80 --json
brdfguide export rough-plastic --to gltf -o "${TMPDIR:-/tmp}/rough_plastic.gltf" --force
