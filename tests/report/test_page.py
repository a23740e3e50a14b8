"""The report page: what it says, that it needs nothing else, and how a real browser shows it."""

import json
import re
import shutil
import subprocess
from base64 import b64decode
from io import BytesIO

import numpy as np
import pytest
from PIL import Image

from brdfguide.errors import InputError
from brdfguide.report import page, render
from brdfguide.report.figures import ranking as plot
from brdfguide.report.figures import spheres

from .test_plot import ranking, scan

FIT = {
    "schema": "brdfguide/fit/1",
    "data": {
        "file": "a<b>.csv",
        "format": "table",
        "samples": 165,
        "channels": ["450nm", "550nm"],
        "theta_i_deg": [10.0, 75.0],
        "values": 330,
        "missing": 3,
        "in_plane": True,
        "findings": [
            {"code": "mirror-side", "severity": "warning", "text": "peaks at theta_r > 0", "option": "--mirror-side"}
        ],
    },
    "ranking": [
        {
            "rank": 1,
            "tied": True,
            "model": "lambertian+ward",
            "candidate": "lambertian+ward",
            "off_percent": 1.32,
            "rms_ln": 0.0131,
            "seen": 0.43,
            "seen_says": "looks alike side by side",
            "close": True,
            "rms_ln_by_theta_i": {"10": 0.01, "75": 0.02},
            "held_out_rms_ln": 0.0172,
            "behind": 0.0,
            "behind_se": 0.0,
            "time_per_sample_ns": 31.0,
            "on_front": True,
            "parameters": {
                "lambertian.albedo": {
                    "value": [0.4, 0.5],
                    "stderr": [0.01, None],
                    "unit": "",
                    "at_bound": None,
                    "fitted": True,
                },
                "ward.alpha": {"value": 0.2, "stderr": 0.001, "unit": "", "at_bound": "high", "fitted": True},
            },
            "flags": [{"code": "undetermined:ward.alpha", "severity": "warning", "text": "do not trust <alpha>"}],
        },
        {
            "rank": 2,
            "tied": False,
            "model": "ward",
            "candidate": "ward",
            "off_percent": 49.2,
            "rms_ln": 0.4,
            "rms_ln_by_theta_i": {"10": 0.3, "75": 0.5},
            "held_out_rms_ln": 0.6,
            "behind": 0.39,
            "behind_se": 0.02,
            "time_per_sample_ns": 20.0,
            "on_front": True,
            "parameters": {},
            "flags": [],
        },
    ],
    "recommended": "lambertian+ward",
    "because": "least error",
    "warnings": [],
    "left_out": [{"term": "ggx", "error": 0.002, "saving_ns": 41.0, "why": "below 1 JND"}],
}
MATERIAL = {
    "schema": "brdfguide/recommend/1",
    "name": "office paper",
    "material": {"n": {"value": 1.5, "from": "rule", "rule": "usual_dielectric_index", "section": "5.1"}},
    "domain": {"status": "flagged", "reasons": ["velvet is not a height field"]},
    "advice": [
        {
            "rule": "usual_dielectric_index",
            "section": "5.1",
            "says": "n = 1.5, the usual value",
            "because": "section 5.1",
            "sets": {"n": 1.5},
        }
    ],
    "candidates": [{"model": "lambertian+he-torrance", "start": {"he-torrance.n": 1.5}, "why": "rises toward grazing"}],
}
BROWSER = shutil.which("chromium") or shutil.which("chromium-browser") or shutil.which("google-chrome")

# Walks every piece of text: its colour against the nearest background that is painted, by WCAG 2's ratio.
PROBE = """<script>
const lum = c => { const f = c.match(/[\\d.]+/g).slice(0, 3)
    .map(v => { v /= 255; return v <= .04045 ? v / 12.92 : ((v + .055) / 1.055) ** 2.4; });
  return .2126 * f[0] + .7152 * f[1] + .0722 * f[2]; };
const back = e => { for (; e; e = e.parentElement) {
  const b = getComputedStyle(e).backgroundColor; if (!/, 0\\)$|transparent/.test(b)) return b; }
  return 'rgb(255,255,255)'; };
const ratio = (a, b) => { const [x, y] = [lum(a), lum(b)].sort((p, q) => q - p); return (x + .05) / (y + .05); };
window.addEventListener('load', () => { const worst = {text: 99, figure: 99}; let texts = 0;
  const walk = document.createTreeWalker(document.body, NodeFilter.SHOW_TEXT);
  while (walk.nextNode()) { const e = walk.currentNode.parentElement;
    if (e.closest('script,svg') || !walk.currentNode.data.trim()) continue;
    texts++; worst.text = Math.min(worst.text, ratio(getComputedStyle(e).color, back(e))); }
  document.querySelectorAll('svg g[id*="text_"] use, svg g[id*="text_"] path').forEach(e => {
    const f = getComputedStyle(e).fill;
    if (f.startsWith('rgb(')) worst.figure = Math.min(worst.figure, ratio(f, back(e))); });
  const ids = [...document.querySelectorAll('[id]')].map(e => e.id);
  document.title = JSON.stringify({...worst, texts,
    wide: document.documentElement.scrollWidth - innerWidth, inner: innerWidth,
    clipped: [...document.querySelectorAll('.wide')].filter(e => e.scrollWidth > e.clientWidth).length,
    figures: document.querySelectorAll('figure svg').length, repeated: ids.length - new Set(ids).size,
    drawn: [...document.querySelectorAll('figure svg')].every(s => s.getBoundingClientRect().height > 100),
    requests: performance.getEntriesByType('resource').filter(r => !r.name.startsWith('data:')).map(r => r.name)}); });
</script>"""


@pytest.fixture(scope="module")
def fitted() -> str:
    with pytest.MonkeyPatch.context() as small:
        small.setattr(spheres, "SMALL", 32)
        small.setattr(render, "THETAS", 8)  # the road is tested here, not the picture
        figures = plot.ranking_figures(ranking(), scan())
    return page.html(FIT, figures, command="brdfguide fit a.csv", files=[__file__])


def text_of(html: str) -> str:
    visible = re.sub(r"<(script|style|svg).*?</\1>", "", html, flags=re.S)
    return re.sub(r"\s+", " ", re.sub(r"<[^>]*>", " ", visible))


def test_the_answer_comes_first(fitted):
    words = text_of(fitted)
    assert (
        words.index("lambertian+ward")
        < words.index("Typically 1.3 % off")
        < words.index("Ranking")
        < words.index("Doubts")
    )
    assert "On a sphere under lamps all around it looks alike side by side: 0.4 L*." in words
    assert " 0.43~ " in words and "~ comes close enough to it" in words
    assert "1.7 % off at incidence angles that it was not fitted to" in words
    assert re.search(r'>lambertian\+ward<.*?<span title="rms ln 0.0131">1.3 %</span>', fitted, re.S)


def test_nothing_comes_from_elsewhere(fitted):
    assert not re.search(r"(?:src|href)=\"(?!data:|#|f\d)[^\"]*\"|@import|url\((?!#|&quot;#)", fitted)


def test_nothing_in_a_dark_page_stays_white(fitted):
    """Its pictures hold no paper: previews are pixels alone, and a difference is clear where there is none."""
    pictures = [
        Image.open(BytesIO(b64decode(each))) for each in re.findall(r"data:image/png;base64,([\w+/=]+)", fitted)
    ]
    assert [each.mode for each in pictures] == ["RGB", "RGB", "RGBA"] and {each.size for each in pictures} == {(32, 32)}
    clear = np.array(pictures[2])
    assert clear[0, 0, 3] == 0 and clear[..., 3].max() > 0  # the sky is the same
    words = text_of(fitted)
    assert "minus lambertian+ward" in words and "just noticeable steps of luminance" in words


def test_what_the_file_is_called_cannot_become_markup(fitted):
    assert "<b>.csv" not in text_of(fitted) and "a&lt;b&gt;.csv" in fitted and "do not trust &lt;alpha&gt;" in fitted


def test_doubts_carry_their_codes_and_the_option_that_overrides(fitted):
    words = text_of(fitted)
    assert (
        "undetermined:ward.alpha" in words
        and "peaks at theta_r &gt; 0" in words
        and "--mirror-side overrides it" in words
    )


def test_the_whole_result_stands_in_the_page(fitted):
    found = re.search(r'<script type="application/json" id="result">(.*?)</script>', fitted, re.S).group(1)
    assert json.loads(found) == FIT


def test_growth_and_every_scale_stand_in_tables():
    growth = {"theta_i_deg": [10.0, 75.0], "r_mirror": 12.5, "r_max": 26.5, "r_mirror_data": 13.5, "r_max_data": 30.5}
    rows = [{**row, "growth": growth if place == 0 else None} for place, row in enumerate(FIT["ranking"])]
    orders = {
        "ln": ("energy & ratios", ["lambertian+ward", "ward"]),
        "cosine": ("the peak", ["ward", "lambertian+ward"]),
    }
    scales = {
        name: {
            "counts": counts,
            "order": [{"candidate": each, "error": 0.125 * (place + 1)} for place, each in enumerate(order)],
        }
        for name, (counts, order) in orders.items()
    }
    made = page.html({**FIT, "ranking": rows, "scales": scales})

    def cells(start):
        return re.sub(r"<[^>]+>", " ", made[made.index(start) : made.index("</tr>", made.index(start))]).split()

    assert cells("<i>the data</i>") == ["the", "data", "13.5", "30.5"]
    by_angle, by_scale = made[made.index("growth toward grazing") :], made[made.index("error on each scale") :]

    def line(table):
        return (
            re.sub(
                r"<[^>]+>",
                " ",
                table[table.index(">lambertian+ward<") : table.index("</tr>", table.index(">lambertian+ward<"))],
            )
            .strip(" >")
            .split()
        )

    assert line(by_angle)[1:] == ["0.01", "0.02", "12.5", "26.5"]
    assert line(by_scale)[1:] == ["0.125", "1", "0.25", "2"]
    assert "energy &amp; ratios" in made


def test_the_page_can_be_repeated_from(fitted):
    words = text_of(fitted)
    assert "brdfguide fit a.csv" in words and re.search(r"SHA-256 [0-9a-f]{64}", words) and "numpy" in words


def test_what_was_left_out_is_priced(fitted):
    assert re.search(r"ggx 0.002 41 below 1 JND", text_of(fitted))


def test_a_material_without_data_says_what_it_rests_on():
    words = text_of(page.html(MATERIAL))
    assert "Reflectance of office paper" in words and "From guidelines alone: no measurement was given" in words
    assert (
        "usual_dielectric_index, section 5.1" in words
        and "velvet is not a height field" in words
        and "he-torrance.n=1.5" in words
    )


def test_a_surface_outside_the_domain_gets_no_model():
    words = text_of(page.html({**MATERIAL, "domain": {"status": "outside", "reasons": ["hair has no surface"]}}))
    assert (
        words.index("No trustworthy answer")
        < words.index("hair has no surface")
        < words.index("lambertian+he-torrance")
    )


def test_a_folder_that_is_not_there_is_named(tmp_path):
    with pytest.raises(InputError, match="cannot write .*nowhere"):
        page.write(FIT, tmp_path / "nowhere" / "a.html")


@pytest.mark.browser
@pytest.mark.parametrize("scheme", ["light", "dark"])
@pytest.mark.parametrize("width", [390, 1100])
def test_a_browser_shows_it(fitted, tmp_path, scheme, width):
    """Drawn without console errors or requests, with contrast of 4.5 and more, and nothing wider than the window."""
    if not BROWSER:
        pytest.skip("no chromium on this machine")
    inner, outer = tmp_path / "page.html", tmp_path / "frame.html"
    inner.write_text(fitted.replace("</body>", PROBE + "</body>"))
    # a headless window is at least 500 wide, so the page stands in a frame of the wanted width and sends up what it saw
    told = "addEventListener('load', () => setTimeout(() => parent.postMessage(document.title, '*'), 50))"
    inner.write_text(inner.read_text().replace("</body>", f"<script>{told}</script></body>"))
    outer.write_text(
        f'<html><body><iframe src="page.html" style="width:{width}px;height:3000px;border:0"></iframe>'
        "<script>addEventListener('message', e => document.body.innerHTML = '<pre>' + e.data + "
        "'</pre>')</script></body></html>"
    )
    run = subprocess.run(
        [
            BROWSER,
            "--headless",
            "--no-sandbox",
            "--disable-gpu",
            f"--user-data-dir={tmp_path / 'profile'}",
            "--virtual-time-budget=4000",
            "--enable-logging=stderr",
            f"--blink-settings=preferredColorScheme={int(scheme == 'light')}",
            "--window-size=1200,3000",
            "--dump-dom",
            outer.as_uri(),
        ],
        capture_output=True,
        text=True,
        timeout=300,
    )
    found = re.search(r"<pre>(.*?)</pre>", run.stdout, re.S)
    assert found, run.stderr[-2000:]
    seen = json.loads(found.group(1).replace("&gt;", ">").replace("&lt;", "<").replace("&amp;", "&"))
    assert "CONSOLE" not in run.stderr, run.stderr
    assert seen["requests"] == [] and seen["repeated"] == 0
    assert seen["figures"] == 2 and seen["drawn"] and seen["texts"] > 80
    assert seen["inner"] == width and seen["wide"] <= 0
    assert seen["clipped"] == (2 if width < 900 else 0)  # a phone scrolls within its two figures, and nothing else
    assert seen["text"] >= 4.5 and 4.5 <= seen["figure"] < 99


def test_a_surface_outside_the_guide_is_a_doubt_and_no_remark():
    outside = {"code": "retro-reflector", "severity": "outside", "text": "a lobe toward the source"}
    words = page.html({**FIT, "data": {**FIT["data"], "findings": [outside]}})
    doubts, data = (
        re.search(f'<section id="{name}">(.*?)</section>', words, re.S).group(1) for name in ("doubts", "data")
    )
    assert "a lobe toward the source" in doubts and "a lobe toward the source" not in data
