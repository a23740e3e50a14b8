"""The explorer as HTML: a page of its own, or a block in a report's page. Nothing comes from the network."""

import json
import re
from html import escape
from importlib.resources import files

from ...errors import InputError
from .shaders import closed_up, unindented

STRING = re.compile(r"('(?:[^'\\\n]|\\.)*')")
SIGNS = re.compile(r"(?<! ) *([=*<>(),;{}?:&|]|(?<!\+)(?<!\+ )\+(?! *\+)|(?<!-)(?<!- )-(?! *-)) *")
LINES = re.compile(r"(?<=[;{,])\n")  # no line of code with a comment behind it ends so
POLICY = "default-src 'none'; script-src 'unsafe-inline'; style-src 'unsafe-inline'; img-src data:"
BODY = """<div id="explorer">
<div class="look"><p data-is="says" aria-live="polite"></p>
<canvas data-is="picture" width="512" height="512" role="img" aria-label="sphere and bent sheet"></canvas>
<p class="soft" data-is="card"></p>
<div class="row"><label data-is="wiped">A <input type="range" data-is="wipe" min="0" max="1" step="0.005"
aria-label="wipe, A to its left, B to its right"> B</label>
<label data-is="compared">show <select data-is="mode"><option value="wipe">A | B</option><option
value="difference">B - A in just noticeable differences, full colour at 20</option></select></label>
<label>sun <select data-is="light"><option>side</option><option>front</option><option>back</option></select></label>
<label>object <select data-is="object"><option value="0">sphere and sheet</option><option
value="1">sphere</option></select></label>
<button type="button" data-is="reset">back to where it began</button></div></div>
<div><div class="pair"><section class="a"><h2><label>A <select data-is="pick-a"></select></label></h2><div
data-is="knobs-a"></div></section>
<section class="b" data-is="side-b"><h2><label>B <select data-is="pick-b"></select></label></h2><div
data-is="knobs-b"></div></section></div>
<section data-is="contour"><h2>Where a mirror image emerges</h2>
<div class="row"><label><input type="checkbox" data-is="lock"> stay on the contour of</label> <label><input
type="number" data-is="angle" min="55" max="88" step="0.5" aria-label="angle of emergence, degrees"> deg</label></div>
<canvas data-is="chart" tabindex="0" role="application"
aria-label="sigma over slope: arrows walk along the contour, with shift across"></canvas>
<p class="soft" data-is="reading" aria-live="polite"></p></section></div>
<div class="wide"><canvas data-is="cuts" role="img"
aria-label="BRDF in the plane of incidence over the reflection angle"></canvas></div>
<div><canvas data-is="polar" role="img" aria-label="the same as polar lobes"></canvas></div>
<div><div class="row"><button type="button" data-copy="words">copy as words</button><button type="button"
data-copy="json">copy as JSON</button>
<button type="button" data-copy="yaml">copy as YAML</button>
<button type="button" data-copy="export">copy the export command</button><span class="soft" data-is="copied"
aria-live="polite"></span></div>
<textarea data-is="text" readonly aria-label="the numbers of A"></textarea></div>
</div>"""
PAGE = """html{background:#fff;color:#1f2328}body{margin:0 auto;max-width:72rem;padding:1rem;
 font-family:system-ui,"DejaVu Sans",sans-serif}
h1{font-size:1.25rem;margin:.2rem 0 .8rem}noscript{display:block;padding:1rem}
@media (prefers-color-scheme:dark){html{background:#14171a;color:#e8eaed}}"""


def explorer_page(state: dict, title: str) -> str:
    """A whole page of `explorer_state`. The same state gives the same bytes."""
    return (
        '<!doctype html>\n<html lang="en"><head><meta charset="utf-8">'
        f'<meta http-equiv="Content-Security-Policy" content="{POLICY}">'
        '<meta name="viewport" content="width=device-width,initial-scale=1">'
        '<meta name="color-scheme" content="light dark">'
        f'<link rel="icon" href="data:,"><title>{escape(title)}</title><style>{PAGE}</style></head>\n'
        f"<body><h1>{escape(title)}</h1>\n{explorer_block(state)}\n</body></html>\n"
    )


def explorer_block(state: dict) -> str:
    """The same as a part of another page, which holds it once."""
    twins = state["twins"]
    known = {key: value for key, value in state.items() if key != "twins"}
    data = json.dumps(known, allow_nan=False, separators=(",", ":")).replace("<", "\\u003c")
    script = f"const TWINS = [{','.join(twins)}];\n{_part('script.js')}"
    if "</script" in script.lower():
        raise InputError("the page's script would end before its time")
    noscript = "<noscript>The explorer needs JavaScript, and nothing besides.</noscript>"
    return (
        f"<style>{_part('style.css')}</style>\n{BODY}\n{noscript}"
        f'<script type="application/json" id="explorer-state">{data}</script>\n<script>{script}</script>'
    )


def _part(name: str) -> str:
    """A file of this folder, without spaces about signs where it is no string."""
    text = unindented(files(__package__).joinpath(name).read_text(encoding="utf-8"))
    if not name.endswith(".js"):
        return text
    parts = STRING.split(text)  # every second one is a string
    return "".join(part if place % 2 else LINES.sub("", closed_up(SIGNS, part)) for place, part in enumerate(parts))
