"""Of every option of every command: a line on which it changes the answer."""

from dataclasses import dataclass

EXEMPT = {
    "--json": "the same answer in another form; each command's own tests compare the two",
    "--quiet": "the same answer without its notes, which are on stderr",
    "--debug": "a traceback where there is an error; no answer changes",
    "--install-completion": "Typer's; writes to the user's shell",
    "--show-completion": "Typer's; prints for the user's shell",
}
SOONER = {
    "fit --jobs": "the same answer sooner: see test_processes_change_no_answer, and its refusal below",
    "fit --scheduler": "the same answer elsewhere: see tests/batch/test_scheduler.py",
    "fit --retries": "of a process that somebody ends: see tests/batch/test_workers.py",
    "fit --failed-again": "what failed is tried again: see tests/batch/test_store.py",
}
# One group of options, whose rows are those of `fit`; see tests/batch/test_other_work.py.
OF_MANY = ("files-from", "null", "include", "recurse", "shard", "jobs", "scheduler", "out", "timeout", "memory")
OF_MANY += ("retries", "failed-again", "events", "keep-going")
SOONER |= {f"{command} --{name}": "as of fit" for command in ("recommend", "inspect", "export") for name in OF_MANY}


@dataclass(frozen=True)
class Acts:
    """`more` typed after `line` gives another answer: status, standard output or files."""

    more: str = ""
    line: str | None = None  # None: the command's own in LINES
    instead: str | None = None  # the whole line with the option, where it does not go without something else
    shows: str | None = None  # a word that is there with the option alone, where times differ from run to run
    hides: str | None = None  # a word that is there without the option alone


CHART = "--chart 30,60 300,40 310,235 40,270"
SCATTERING = "scatter abg a=1e-4 b=1e-5 g=1.8"
LINES = {
    "": "",
    "collect": "collect {answers} -o {out}/it.jsonl --json",
    "search": "search {answers}",
    "prune-answers": "prune-answers {answers} --json",
    "fit": "fit {dome} -m lambertian+ward,lambertian+phong --json --no-timing",
    "recommend": "recommend porcelain --json --no-timing",
    "inspect": "inspect {dome} --json",
    "convert": "convert {dome} {out}/it.csv",
    "evaluate": "evaluate lambertian+ggx",
    "export": "export --model lambertian+ward ward.alpha=0.2 --to mitsuba -o {out}/it.xml",
    "compare": "compare lambertian+ggx lambertian+ward",
    "gloss": "gloss --at-60 40",
    "scatter": "scatter --ra 12nm",
    "roughness": "roughness --angle 70",
    "albedo": "albedo --between white black",
    "index": "index --n 1.5",
    "materials": "materials",
    "models": "models",
    "schema": "schema",
    "examples": "examples {out}",
    "numbers": "numbers lambertian+ggx",
    "figures": "figures {out} --only 2",
    "preview": "preview lambertian --size 64 -o {out}/it.png",
    "explore": "explore lambertian -o {out}/it.html",
    "check": "check ward",
    "bench": "bench -m lambertian",
    "verify": "verify {fit}",
    "plan": "plan porcelain --budget 2 --theta-max 40 --json",
}
READING = {
    "--wavelength": "--wavelength 550",
    "--in-plane": "--in-plane",
    "--theta-max": "--theta-max 60",
    "--columns": "--columns brdf=G",
    "--unit": "--unit rad",
    "--quantity": "--quantity brdf-cos",
    "--mirror-side": "--mirror-side phi=180",
    "--average-phi-i": "--average-phi-i",
    "--rotation-sense": "--rotation-sense cw",
    "--scale": "--scale 0.5",
    "--wavelength-nm": "--wavelength-nm 633",
    "--select": "--select paint=2",
}


def reading(start: str, end: str = "") -> dict[str, Acts]:
    """The options about a file's meaning, each on a file where it matters."""
    files = {
        "--unit": "{small}",
        "--average-phi-i": "{turned}",
        "--rotation-sense": "{grained}",
        "--wavelength-nm": "{doubtful}",
        "--select": "{paints}",
    }
    return {name: Acts(more, f"{start} {files.get(name, '{dome}')} {end}") for name, more in READING.items()}


ACTS = {
    "": {"--version": Acts("--version"), "--explain": Acts("--explain at-bound")},
    "fit": reading("fit", "-m lambertian+ward --json --no-timing")
    | {
        "--models": Acts("-m lambertian+ggx"),
        "--kind": Acts("--kind metal", "fit {dome} -m ggx --json --no-timing"),
        "--metric": Acts("--metric cube-root"),
        "--close": Acts("--close none", "fit {dome} -m lambertian+ggx,lambertian+beckmann --json --no-timing"),
        "--weights": Acts("--weights none", "fit {doubtful} -m lambertian+ward --json --no-timing"),
        "--robust": Acts("--robust"),
        "--per-channel-shape": Acts("--per-channel-shape"),
        "--fix": Acts("--fix ward.alpha=0.3"),
        "--start": Acts("--start ward.alpha=0.9"),
        "--aperture-deg": Acts("--aperture-deg 3"),
        "--anyway": Acts("--anyway", "fit {tape} -m lambertian --json --no-timing"),
        "--turned": Acts(instead="fit {doubtful} {doubtful} --turned 0,90 -m lambertian+ward --json --no-timing"),
        "--scene": Acts("--scene default"),
        "--plot": Acts("--plot {out}/it.svg"),
        "--x": Acts(instead="fit {dome} -m lambertian --no-timing --plot {out}/it.svg --x beta"),
        "--theme": Acts("--theme dark", "fit {dome} -m lambertian --no-timing --plot {out}/it.svg"),
        "--report": Acts("--report {out}/it.html", "fit {dome} -m lambertian --no-timing"),
        "--explore": Acts("--explore", "fit {dome} -m lambertian --no-timing --report {out}/it.html"),
        "--residuals": Acts("--residuals {out}/it.csv"),
        "--explain": Acts("--explain", "fit examples/white_paper.csv --quiet --no-timing"),
        "--next": Acts("--next"),
        "--full": Acts("--full", "fit {dome} -m lambertian+ward --no-timing"),
        "--baselines": Acts("--baselines"),
        "--basis-from": Acts(
            "--basis-from examples", "fit examples/white_paper.csv -m lambertian --baselines --json --no-timing"
        ),
        "--out": Acts("--out {out}/fits"),
        "--products": Acts("--products residuals", "fit {dome} -m lambertian --no-timing --out {out}/fits"),
        "--files-from": Acts(instead="fit --files-from {list} -m lambertian --json --no-timing"),
        "--null": Acts("-0", instead="fit --files-from {zeros} -0 -m lambertian --json --no-timing"),
        "--include": Acts("--include dome.csv", "fit {few} -m lambertian --json --no-timing"),
        "--recurse": Acts("--recurse", "fit {few} -m lambertian --json --no-timing"),
        "--shard": Acts(
            "--shard 0/2", "fit examples/white_paper.csv examples/rough_plastic.csv -m lambertian --json --no-timing"
        ),  # which part is whose hangs on the names, so they are none of a temporary folder's
        "--timeout": Acts("--timeout 0.001", "fit {few} -m lambertian --no-timing"),
        "--memory": Acts("--memory 30", "fit {few} -m lambertian --no-timing"),
        "--events": Acts("--events {out}/it.jsonl", "fit {few} -m lambertian --no-timing", shows="it.jsonl"),
        "--keep-going": Acts("--keep-going", "fit {dome} {hair} -m lambertian --no-timing"),
        "--group": Acts("--group paint", "fit {paints} -m lambertian --json --no-timing"),
        "--as": Acts("--as gltf", "fit {dome} -m lambertian --json --no-timing"),
        "--numbers": Acts("--numbers", "fit {dome} -m lambertian --json --no-timing"),
        "--export": Acts("--export mitsuba:{out}/it.xml"),
        "--max-export-error": Acts(
            "--max-export-error 0", "fit {dome} -m lambertian+ward --json --no-timing --export mitsuba:{out}/it.xml"
        ),
        "--no-timing": Acts("--no-timing", "fit {dome} -m lambertian --json", hides="time_per_sample_ns"),
    },
    "collect": {
        "--output": Acts("-o {out}/it.csv", shows="it.csv"),
        "--fail-missing": Acts("--fail-missing {list}"),
    },
    "prune-answers": {"--yes": Acts("--yes", "prune-answers {left} --json", shows='"removed": true')},
    "search": {
        "--like": Acts("--like lambertian"),
        "--alike": Acts("--alike"),
        "--scene": Acts("--scene {rim}", "search {answers} --like lambertian --json"),
        "--most": Acts("--most 1"),
        "--sheet": Acts("--sheet {out}/it.png", shows="it.png"),
    },
    "recommend": {
        "--models": Acts("-m lambertian+ggx"),
        "--scene": Acts("--scene default"),
        "--plot": Acts("--plot {out}/it.svg"),
        "--theme": Acts("--theme dark", "recommend porcelain -m lambertian --no-timing --plot {out}/it.svg"),
        "--report": Acts("--report {out}/it.html", "recommend porcelain -m lambertian --no-timing"),
        "--explore": Acts("--explore", "recommend porcelain -m lambertian --no-timing --report {out}/it.html"),
        "--explain": Acts("--explain"),
        "--full": Acts("--full", "recommend porcelain --no-timing"),
        "--anyway": Acts("--anyway", "recommend {hair} --json --no-timing"),
        "--as": Acts("--as gltf"),
        "--numbers": Acts("--numbers", "recommend copper -m ggx --json --no-timing"),
        "--export": Acts("--export mitsuba:{out}/it.xml"),
        "--max-export-error": Acts(
            "--max-export-error 0", "recommend satin-plastic --no-timing --export gltf:{out}/it.gltf"
        ),
        "--no-timing": Acts("--no-timing", "recommend porcelain --full", hides="  ns  "),
    },
    "inspect": reading("inspect")
    | {
        "--sarif": Acts("--sarif", "inspect {dome}"),
        "--plot": Acts("--plot {out}/it.svg"),
        "--theme": Acts("--theme dark", "inspect {dome} --plot {out}/it.svg"),
        "--turned": Acts(instead="inspect {doubtful} {doubtful} --turned 0,90 --json"),
    },
    "convert": reading("convert", "{out}/it.csv")
    | {
        "--model": Acts("-m lambertian+phong", "convert {fit} {out}/it.binary"),
        "--to": Acts("--to fred", "convert examples/white_paper.csv {out}/it.csv"),
        "--from": Acts("--from ward", "convert --to ggx alpha=0.2 rho_s=0.1"),
        "--force": Acts("--force", "convert {dome} {there}"),
    },
    "evaluate": {
        "--fit": Acts("--fit {fit}", "evaluate"),
        "--model": Acts("--model lambertian+phong", "evaluate --fit {fit}"),
        "--data": Acts("--data examples/white_paper.csv"),
        "--theta-i": Acts("--theta-i 30"),
        "--theta-r": Acts("--theta-r 30"),
        "--phi": Acts("--phi 30"),
        "--wavelength-nm": Acts("--wavelength-nm 450", "evaluate he-torrance"),
    },
    "export": {
        "--to": Acts("--to pbrt"),
        "--output": Acts("-o -"),
        "--model": Acts("--model lambertian+phong", "export {fit} --to mitsuba -o {out}/it.xml"),
        "--channel": Acts("--channel R", "export {fit} --to mitsuba -o {out}/it.xml"),
        "--data": Acts("--data examples/rough_plastic.csv"),
        "--name": Acts("--name paint"),
        "--max-export-error": Acts("--max-export-error 0"),
        "--force": Acts("--force", "export --model ggx --to mitsuba -o {there}"),
    },
    "compare": {
        "--to": Acts(instead="compare lambertian+ggx --to gltf"),
        "--aperture-deg": Acts("--aperture-deg 3"),
        "--anyway": Acts("--anyway", "compare {turned} ggx"),
        "--plot": Acts("--plot {out}/it.svg"),
        "--theme": Acts("--theme dark", "compare lambertian phong --plot {out}/it.svg"),
    },
    "examples": {"--force": Acts("--force", "examples {whole}")},
    "gloss": {
        "--at-20": Acts("--at-20 10"),
        "--at-60": Acts("--at-60 40", "gloss --at-20 10"),
        "--at-85": Acts("--at-85 60"),
        "--alpha": Acts("--alpha 0.1", "gloss"),
        "--n": Acts("--n 1.6"),
        "--albedo": Acts("--albedo 0.5"),
        "--lobe": Acts("--lobe ggx"),
    },
    "scatter": {
        "--tis": Acts("--tis 0.01", "scatter", instead="scatter --tis 0.01"),
        "--haze": Acts("--haze 0.01", "scatter", instead="scatter --haze 0.01"),
        "--sigma": Acts("--sigma 2nm", "scatter", instead="scatter --sigma 2nm"),
        "--ra": Acts("--ra 2nm", "scatter", instead="scatter --ra 2nm"),
        "--rsm": Acts("--rsm 20um"),
        "--rdq": Acts("--rdq 0.01"),
        "--stop-deg": Acts("--stop-deg 5", "scatter {mirror} --tis 0.01"),
        "--band": Acts("--band 2.5um:0.8mm"),
        "--wavelength-nm": Acts("--wavelength-nm 633"),
        "--theta-i": Acts("--theta-i 60"),
        "--f0": Acts("--f0 0.5", SCATTERING),
        "--n": Acts("--n 1.5", SCATTERING),
        "--k": Acts("--k 7", SCATTERING + " --n 1.5"),
        "--to-nm": Acts("--to-nm 10600"),
        "--beta": Acts("--beta 0.01:0.5", SCATTERING),
        "--plot": Acts("--plot {out}/it.svg", SCATTERING),
        "--theme": Acts("--theme dark", SCATTERING + " --plot {out}/it.svg"),
    },
    "roughness": {
        "--angle": Acts("--angle 60"),
        "--angle-error": Acts("--angle-error 1"),
        "--angle-across": Acts("--angle-across 69", "roughness --angle 70 --slope 0.5"),
        "--highlight-half-width": Acts(line="roughness --angle 70", instead="roughness --highlight-half-width 8"),
        "--mirror": Acts(line="roughness --angle 70", instead="roughness --mirror {dimmed}"),
        "--slope": Acts("--slope 0.2"),
        "--sigma-um": Acts("--sigma-um 0.5"),
        "--tau-um": Acts("--tau-um 5"),
        "--wavelength-nm": Acts("--wavelength-nm 450"),
        "--pupil-mm": Acts("--pupil-mm 4"),
        "--distance-mm": Acts("--distance-mm 500"),
        "--never": Acts("--never"),
        "--contour": Acts("--contour"),
        "--full": Acts("--full"),
        "--batch": Acts("--batch {angles}"),
        "--plot": Acts("--plot {out}/it.svg"),
        "--theme": Acts("--theme dark", "roughness --angle 70 --plot {out}/it.svg"),
    },
    "albedo": {
        "--patch": Acts("--patch white", "albedo"),
        "--between": Acts("--between white black", "albedo"),
        "--position": Acts("--position 0.3"),
        "--ratio": Acts(line="albedo", instead="albedo --ratio 0.3 --reference 0.9"),
        "--reference": Acts(line="albedo --ratio 0.3 --reference 0.9", instead="albedo --ratio 0.3 --reference 0.8"),
        "--data-set": Acts("--data-set iso17321"),
        "--photo": Acts(line="albedo", instead=f"albedo --photo {{desk}} {CHART} --sample 335,100,50,70"),
        "--sample": Acts(
            line=f"albedo --photo {{desk}} {CHART} --sample 335,100,50,70",
            instead=f"albedo --photo {{desk}} {CHART} --sample 335,100,20,70",
        ),
        "--chart": Acts(
            line=f"albedo --photo {{desk}} {CHART} --sample 335,100,50,70",
            instead="albedo --photo {desk} --chart 31,60 300,40 310,235 40,270 --sample 335,100,50,70",
        ),
    },
    "index": {
        "--f0": Acts("--f0 0.04", "index"),
        "--n": Acts("--n 1.5", "index"),
        "--k": Acts("--k 2"),
        "--wavelength-nm": Acts("--wavelength-nm 450", "index gold"),
    },
    "materials": {"--keys": Acts("--keys")},
    "models": {},
    "numbers": {},
    "figures": {
        "--only": Acts("--only 1"),
        "--data": Acts("--data 5={dome}", "figures {out} --only 5"),
        "--format": Acts("--format svg"),
        "--theme": Acts("--theme dark"),
    },
    "explore": {
        "--data": Acts("--data {dome}"),
        "--output": Acts("-o {out}/other.html"),
    },
    "preview": {
        "--compare": Acts("--compare lambertian"),
        "--row": Acts("--row albedo=0.2..0.8/2"),
        "--output": Acts("-o {out}/other.png"),
        "--env": Acts("--env sky"),
        "--object": Acts("--object disc"),
        "--light": Acts("--light back"),
        "--size": Acts("--size 80"),
    },
    "check": {
        "--fit": Acts(instead="check --fit {fit}"),
        "--model": Acts("--model lambertian+phong", "check --fit {fit}"),
        "--certify": Acts("--certify {dome}", "check --fit {fit}", shows="SciPy"),
    },
    "plan": {
        "--budget": Acts("--budget 3"),
        "--scans": Acts("--scans"),
        "--after": Acts("--after {doubtful}", "plan --budget 2 --theta-max 40 --json"),
        "--purpose": Acts("--purpose pin", "plan --budget 2 --theta-max 40 --after {doubtful} --json"),
        "--scene": Acts("--scene default"),
        "--theta-max": Acts("--theta-max 30"),
        "--in-plane": Acts("--in-plane"),
        "--step-deg": Acts("--step-deg 10", "plan porcelain --budget 2 --theta-max 40 --scans --json"),
        "--among": Acts("--among examples/white_paper.csv"),
        "--aperture-deg": Acts("--aperture-deg 5"),
        "--value-s": Acts("--value-s 4"),
        "--move-s": Acts("--move-s 20"),
        "--output": Acts("-o {out}/it.csv"),
        "--plot": Acts("--plot {out}/it.svg"),
        "--force": Acts("--force", "plan porcelain --budget 2 --theta-max 40 -o {there}"),
    },
    "verify": {"--model": Acts("--model lambertian+phong")},
    "bench": {
        "--models": Acts("-m phong", shows="phong"),
        "--plot": Acts("--plot {out}/it.svg", "bench {dome} -m lambertian", shows="it.svg"),
        "--theme": Acts("--theme dark", "bench {dome} -m lambertian --plot {out}/it.svg", shows="#14171a"),
    },
}
