#!/bin/sh
# What a scene does not need of a fitted model, and of a described surface. Run from the project's root.
set -eu
brdfguide fit examples/rough_plastic.csv --models lambertian+he-torrance --scene examples/scenes/frontal_product_shot.yaml
brdfguide recommend satin-plastic --scene examples/scenes/road_at_sunset.yaml
