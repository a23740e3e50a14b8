# A photographed ball, from pictures to a renderer's file.
set -e
folder="$(mktemp -d)"
brdfguide inspect examples/photographs/shots.yaml
brdfguide fit examples/photographs/shots.yaml -m lambertian+ggx,lambertian+beckmann --no-timing --next
brdfguide fit examples/photographs/shots.yaml -m lambertian+ggx --no-timing --json > "$folder/paint.json"
brdfguide export "$folder/paint.json" --to mitsuba -o "$folder/paint.xml"
