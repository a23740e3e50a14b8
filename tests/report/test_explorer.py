"""The explorer's page: its laws against ours in Node, its pixels against the preview's in a browser, its manners."""

import base64
import json
import re
import shutil
import subprocess

import numpy as np
import pytest

from brdfguide import models
from brdfguide.errors import NoAnswer
from brdfguide.exporters import coloured
from brdfguide.exporters.live import live
from brdfguide.face.explorer import explorer_html
from brdfguide.face.surfaces import named_surface
from brdfguide.models.candidates import of_kind
from brdfguide.models.surface import Surface
from brdfguide.physics.emergence import crossing
from brdfguide.physics.geometry import Geometry, rows
from brdfguide.report import render
from brdfguide.report.explorer import state as explorer
from brdfguide.report.explorer.block import explorer_page

from ..conftest import ROOT

NODE = shutil.which("node")
BROWSER = shutil.which("chromium") or shutil.which("chromium-browser") or shutil.which("google-chrome")
RANKED = sorted({each.name for kind in ("metal", "dielectric") for each in of_kind(kind)})
BARE = sorted({word for name in RANKED for word in name.split("+") if ":" not in word} | {"retro"})
EVERY = 4  # pixel along each side, where laws are many
# Each law at the values that CASES gives it, a list of {key: value}; few pixels of each
CORNERS = """<script>const x = document.getElementById('explorer').explorer, out = [];
  x.state.models.forEach((m, n) => { for (const c of CASES[n]) {
    m.knobs.forEach((k, j) => { k.value = k.key in c ? [c[k.key]] : [...m.fitted[j]]; });
    const all = x.paint(m), few = []; let b = '';
    for (let r = EVERY / 2; r < 512; r += EVERY) for (let q = EVERY / 2; q < 512; q += EVERY)
      for (let k = 0; k < 3; k++) few.push(all[4 * (512 * r + q) + k]);
    for (const e of new Uint8Array(new Float32Array(few).buffer)) b += String.fromCharCode(e);
    out.push(btoa(b)); } });
  const p = document.createElement('pre'); p.id = 'corners'; p.textContent = out.join(' '); document.body.append(p);
</script></body>"""
DUMP = """<script>const wait = () => { const r = document.getElementById('explorer'), x = r.explorer;
  const show = (id, text) => { const p = document.createElement('pre');
    p.id = id; p.textContent = text; document.body.append(p); };
  if (r.dataset.done !== 'yes') return setTimeout(wait, 50);
  const packed = a => { const b = new Uint8Array(a.buffer); let s = '';
    for (let i = 0; i < b.length; i += 30000) s += String.fromCharCode(...b.subarray(i, i + 30000)); return btoa(s); };
  x.state.models.forEach((m, k) => m.gl && show('pixels' + k, packed(x.pixels(m))));
  const ink = () => getComputedStyle(r).getPropertyValue('--ink').trim(), printed = [ink()];
  for (const event of ['beforeprint', 'afterprint']) { dispatchEvent(new Event(event)); printed.push(ink()); }
  show('told', JSON.stringify({rms: x.state.models.map(m => x.error(m)), words: x.state.models.map(x.words),
    documents: x.state.models.map(x.documentOf), yaml: x.state.models.map(x.yaml),
    wide: document.documentElement.scrollWidth - innerWidth, printed,
    requests: performance.getEntriesByType('resource').filter(e => !e.name.startsWith('data:')).map(e => e.name)}));
}; setTimeout(wait, 50);</script></body>"""


def shown(*words: str, data=None) -> dict:
    return explorer.explorer_state([explorer.Turned(named_surface(each)) for each in words], data)


def in_node(script: str):
    if NODE is None:
        pytest.skip("no node on this machine")
    run = subprocess.run([NODE, "-"], input=script, capture_output=True, text=True)
    assert run.returncode == 0, run.stderr[-2000:]
    return json.loads(run.stdout)


def in_browser(page: str, folder, *options: str, link: str = "", dump: str = DUMP) -> str:
    if not BROWSER:
        pytest.skip("no chromium on this machine")
    (folder / "page.html").write_text(page.replace("</body>", dump))
    gpu = ("--use-angle=swiftshader", "--enable-unsafe-swiftshader", "--ignore-gpu-blocklist")
    quiet = ("--disable-background-networking", "--no-first-run", "--enable-logging=stderr")
    where = (f"--user-data-dir={folder / 'profile'}", "--virtual-time-budget=120000", "--window-size=1200,1400")
    address = (folder / "page.html").as_uri() + link
    run = subprocess.run(
        [BROWSER, "--headless=new", "--no-sandbox", *gpu, *quiet, *where, *options, "--dump-dom", address],
        capture_output=True,
        text=True,
        timeout=300,
    )
    assert "CONSOLE" not in run.stderr, run.stderr
    return run.stdout


def told(dom: str) -> dict:
    found = re.search(r'<pre id="told">(.*?)</pre>', dom, re.S).group(1)
    for name, letter in (("&lt;", "<"), ("&gt;", ">"), ("&amp;", "&")):
        found = found.replace(name, letter)
    return json.loads(found)


def pixels(dom: str, place: int) -> np.ndarray:
    found = re.search(rf'<pre id="pixels{place}">([^<]*)', dom).group(1)
    return np.frombuffer(base64.b64decode(found), np.float32).reshape(512, 512, 4)[::-1, :, :3]


@pytest.mark.parametrize("name", RANKED)
def test_every_ranked_law_in_javascript_is_the_law(name):
    """Over 400 directions to 89 degrees: 2e-9, as its constants have eight digits; 2e-7 where erfc is an approximation
    (1.5e-7); 2e-6 of bare He-Torrance, where it enters at grazing several times over."""
    model = models.get(name)
    surface = coloured(Surface.named(name, {}), name)
    rng = np.random.default_rng(22)
    theta_i, theta_r, phi = rng.uniform(0, 89, 400), rng.uniform(0, 89, 400), rng.uniform(0, 360, 400)
    geom = rows(Geometry.from_degrees(theta_i, 0.0, theta_r, phi))
    law = live(surface)
    given = {law.ids[key]: float(surface.values.get(key, p.default)) for key, p in model.parameters.items()}
    q, p = geom.vxy2[:, 0], (geom.sin_i * geom.sin_r)[:, 0] * np.cos(np.radians(phi))
    angles = np.stack([geom.cos_i[:, 0], geom.cos_r[:, 0], q, p], axis=1).tolist()
    got = in_node(
        f"const T = {law.javascript}; const V = {json.dumps(given)}; Object.assign(V, T.numbers(V, 0));"
        f"console.log(JSON.stringify({json.dumps(angles)}.map(a => T.finite(V, ...a))))"
    )
    expected = surface.brdf(geom)[:, 0]
    bright = expected > 1e-12 * expected.max()
    bar = 2e-7 if any(word in name for word in ("he-torrance", "beckmann", "student-t")) else 2e-9
    bar = 2e-6 if name == "he-torrance" else bar
    np.testing.assert_allclose(np.array(got)[bright], expected[bright], rtol=bar)


def test_the_contour_of_the_page_is_that_of_roughness():
    script = (ROOT / "brdfguide" / "report" / "explorer" / "script.js").read_text()
    function = script[script.index("function crossing") : script.index("const waving")]
    rng = np.random.default_rng(5)
    asked = np.stack([rng.uniform(55, 88, 200), np.exp(rng.uniform(np.log(0.02), np.log(0.5), 200))], axis=1).tolist()
    contours = shown("he-torrance")["contours"]
    got = in_node(
        f"const S = {{contours: {json.dumps(contours)}}}; {function}"
        f"console.log(JSON.stringify({json.dumps(asked)}.map(p => crossing(p[0], p[1], 0.55))))"
    )
    np.testing.assert_allclose(got, [crossing(*each)[0] for each in asked], rtol=2e-3)


@pytest.mark.browser
@pytest.mark.parametrize("pair", [("ward ward.alpha=0.05", "lambertian+he-torrance sigma=0.15 slope=0.05")])
def test_no_pixel_is_more_than_one_code_from_the_previews(pair, tmp_path):
    dom = in_browser(explorer_page(shown(*pair), "pixels"), tmp_path)
    for place, words in enumerate(pair):
        got, expected = pixels(dom, place), render.render(named_surface(words), 512)
        assert np.isfinite(got).all() and got.min() >= 0
        codes = [np.round(255 * np.clip(render.tone(each), 0, 1)) for each in (got, expected)]
        assert np.abs(codes[0] - codes[1]).max() <= 1
        assert np.quantile(np.abs(got / expected - 1), 0.99) < 2e-3


def corners(name: str) -> list[dict]:
    """Start values, and the least, the middle and the greatest of every number that can be turned but amplitudes."""
    knobs = [k for k in shown(name)["models"][0]["knobs"] if not (k["held"] or k["minor"] or k["linear"])]
    return [{}, *({k["key"]: _at(k, share) for k in knobs} for share in (0.0, 0.5, 1.0))]


def _at(knob: dict, share: float) -> float:
    """Where the page's slider stands at a share of its way."""
    low, high, origin = knob["low"], knob["high"], knob["origin"]
    if not knob["log"] or share == 0:
        return low + share * (high - low)
    least = max(low - origin, (high - origin) * 1e-6, 1e-9)
    return origin + least * ((high - origin) / least) ** share


def few_pixels(surface) -> np.ndarray:
    """Of the preview's 512 x 512, those that `CORNERS` takes, from the top."""
    pick = slice(EVERY // 2 - 1, None, EVERY), slice(EVERY // 2, None, EVERY)
    view, sun = render.view(512), render.sun_direction("side")
    normal, share = view.normal[pick], view.covered[pick][..., None]
    height = 0.9 * ((1 - (np.arange(512) + 0.5) / 512)[pick[0]] - 0.66)
    image = np.array(np.broadcast_to(render.sky(height)[:, None], normal.shape))
    on = share[..., 0] > 0
    lit = render.around_of(surface, normal[on])
    lit += render.sun_of(surface, normal[on], sun) + render.mirror_of(surface, normal[on], sun)
    image[on] += share[on] * (lit - image[on])
    return image


@pytest.mark.browser
@pytest.mark.parametrize("names", [BARE[::2], BARE[1::2]], ids="+".join)
def test_no_law_is_more_than_one_code_from_the_previews_at_the_corners_of_its_box(names, tmp_path):
    page = explorer_page(shown(*names), "corners")
    cases = [corners(name) for name in names]
    dump = CORNERS.replace("CASES", json.dumps(cases)).replace("EVERY", str(EVERY))
    found = re.search(r'<pre id="corners">([^<]*)', in_browser(page, tmp_path, dump=dump)).group(1).split()
    tried = [(name, case) for name, each in zip(names, cases, strict=True) for case in each]
    for (name, case), text in zip(tried, found, strict=True):
        got = np.frombuffer(base64.b64decode(text), np.float32).reshape(512 // EVERY, -1, 3)[::-1]
        assert np.isfinite(got).all() and got.min() >= 0, (name, case)
        expected = few_pixels(coloured(Surface.named(name, {}).with_values(case), name))
        codes = [np.round(255 * np.clip(render.tone(each), 0, 1)) for each in (got, expected)]
        assert np.abs(codes[0] - codes[1]).max() <= 1, (name, case)


@pytest.mark.browser
def test_the_page_tells_the_fits_error_and_its_copies_are_read_back(tmp_path):
    page, names = explorer_html((), ROOT / "examples" / "white_paper.csv")
    from brdfguide import fit

    answer = fit(ROOT / "examples" / "white_paper.csv", timing=False)
    found = told(in_browser(page, tmp_path, "--disable-3d-apis"))
    assert found["requests"] == [] and found["wide"] <= 0
    for name, rms, words, document in zip(names, found["rms"], found["words"], found["documents"], strict=True):
        assert rms == pytest.approx(answer[name].rms_ln, rel=1e-4)
        (tmp_path / "copied.json").write_text(document)
        for again in (named_surface(words), named_surface(str(tmp_path / "copied.json"))):
            for key, value in answer[name].values.items():
                assert np.allclose(again.values[key], value, rtol=1e-7, atol=1e-12), key


@pytest.mark.browser
@pytest.mark.parametrize("words", [("ggx",), ("ggx", "ward")])
def test_only_what_a_page_of_so_many_surfaces_can_do_is_shown(words, tmp_path):
    dom = in_browser(explorer_page(shown(*words), "it"), tmp_path)
    for name in ("side-b", "wiped", "compared"):
        assert (f'data-is="{name}" hidden' in dom) == (len(words) < 2), name


@pytest.mark.browser
def test_a_link_keeps_what_was_moved(tmp_path):
    page = explorer_page(shown("ward", "lambertian+ggx"), "link")
    dark = ("--disable-3d-apis", "--blink-settings=preferredColorScheme=0")
    moved = told(in_browser(page, tmp_path, *dark, link="#a=1&wipe=0.25&1.ggx.alpha=0.4&0.ward.alpha=9e9"))
    assert moved["printed"] == ["#e8eaed", "#1f2328", "#e8eaed"]  # plots of a dark page are drawn anew for paper
    assert "ggx.alpha=0.4" in moved["words"][1]
    assert "ward.alpha=0.2" in moved["words"][0]  # out of bounds: not taken
    (tmp_path / "copied.yaml").write_text(moved["yaml"][1])
    again = named_surface(f"{tmp_path / 'copied.yaml'}#lambertian+ggx").values
    assert [again["lambertian.albedo"], again["ggx.alpha"], again["ggx.n"]] == pytest.approx([0.5, 0.4, 1.5])


@pytest.mark.browser
def test_facets_stand_on_the_contour_at_half_their_alpha_and_keys_walk_along_it(tmp_path):
    press = DUMP.replace(
        "if (r.dataset.done !== 'yes')",
        "if (!r.pressed) { r.pressed = 1; const c = r.querySelector('[data-is=chart]'); c.focus();"
        " for (const key of ['ArrowRight', 'ArrowRight', 'ArrowLeft'])"
        " c.dispatchEvent(new KeyboardEvent('keydown', {key}));"
        " show('focused', document.activeElement === c);"
        " show('reading', r.querySelector('[data-is=reading]').textContent); }"
        " if (r.dataset.done !== 'yes')",
    )
    dom = in_browser(explorer_page(shown("ward ward.alpha=0.1"), "keys"), tmp_path, "--disable-3d-apis", dump=press)
    reading = re.search(r'<pre id="reading">([^<]*)', dom).group(1)
    assert '<pre id="focused">true' in dom and "slope alpha/2 = 0.0515" in reading
    sigma = float(re.search(r"criterion sigma ([\d.]+)", reading).group(1))
    assert sigma == pytest.approx(crossing(75, 0.0515)[0], rel=2e-3)
    assert "ward.alpha=0.103" in told(dom)["words"][0]


def test_a_page_without_data_is_small_needs_nothing_and_is_the_same_each_time():
    page, names = explorer_html(())
    assert names == ["lambertian+ggx", "lambertian+he-torrance"]
    assert len(page.encode()) <= 60_000 and page == explorer_html(())[0]
    assert "default-src 'none'" in page and not re.search(r"https?://|url\(|@import|(src|href)=\"(?!data:)", page)


def test_what_a_surface_is_called_stays_text():
    surface = named_surface("ward")
    hostile = type(surface)(surface.model, surface.values, name="</script><img src=x onerror=1>\"'")
    page = explorer_page(explorer.explorer_state([explorer.Turned(hostile)]), hostile.name)
    assert page.lower().count("</script") == 2 and "<img" not in page


@pytest.mark.parametrize("words, why", [("disney", "states no formula"), ("ggx-aniso", "formula|turns")])
def test_a_law_that_the_page_cannot_turn_is_refused(words, why):
    with pytest.raises(NoAnswer, match=why):
        shown(words)


def test_what_follows_from_a_table_is_held_and_the_rest_is_free():
    law = live(coloured(Surface.named("lambertian+student-t", {}), "x"))
    assert law.held == {"student-t.g"}
    wave = live(coloured(Surface.named("lambertian+he-torrance", {}), "x"))
    assert wave.held == frozenset() and len(wave.numbers) == 2


def test_an_axis_over_a_decade_or_less_has_numbers_between():
    script = (ROOT / "brdfguide" / "report" / "explorer" / "script.js").read_text()
    parts = [
        next(line for line in script.splitlines() if line.startswith(f"const {name} =")) for name in ("short", "power")
    ]
    parts.append(script[script.index("const marks") : script.index("const colours")])
    found = in_node("\n".join(parts) + "console.log(JSON.stringify([marks(-0.9, 0.75), marks(-4, 1)]));")
    assert [label for _, label in found[0]] == ["0.2", "0.5", "1", "2", "5"]
    assert [place for place, _ in found[1]] == [-4, -3, -2, -1, 0, 1]
