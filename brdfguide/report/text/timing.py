"""What each law costs, in words."""

from .table import columns


def text(result: dict) -> str:
    """One line per law: least and median time per sample at each size, operations, error."""
    names = list(dict.fromkeys(row["model"] for row in result["rows"]))
    measured = list(dict.fromkeys(row["n"] for row in result["rows"]))
    sizes = [n for n in measured if n > 1] or measured  # one direction a call is Python's cost and no law's
    by = {(row["model"], row["n"]): row for row in result["rows"]}
    with_error = "data" in result
    kinds = list(result["rows"][0]["operations"])
    if with_error:
        names.sort(key=lambda name: by[name, sizes[-1]]["rms_ln"])
    header = (
        "model",
        *(head for n in sizes for head in (f"ns at {n:.0e}".replace("e+0", "e"), "median")),
        *kinds,
        *(("rms ln", "front") if with_error else ()),
    )
    lines = []
    for name in names:
        cells = [name]
        for n in sizes:
            ns = by[name, n]["time_per_sample_ns"]
            cells += [
                f"{ns['min']:.3g}" if ns["min"] < 1000 else f"{ns['min']:.0f}",
                f"{ns['median']:.3g}" if ns["median"] < 1000 else f"{ns['median']:.0f}",
            ]
        last = by[name, sizes[-1]]
        cells += [f"{last['operations'][kind]:.4g}" for kind in kinds]
        if with_error:
            cells += [f"{last['rms_ln']:.4f}", "*" if last["on_front"] else ""]
        lines.append(cells)
    table = columns(header, lines, right=tuple(range(1, 1 + 2 * len(sizes) + len(kinds) + with_error)))
    m = result["machine"]
    note = (
        f"least and median of interleaved repeats, thread processor time, one thread, float64, directions kept as in "
        f"a fit\noperations per sample by kind, arrays only\n{m['processor']}, {m['cores']} cores, {m['system']}, "
        f"Python {m['python']}, NumPy {m['numpy']}"
    )
    calls = [row["time_per_sample_ns"]["min"] / 1000 for row in result["rows"] if row["n"] == 1]
    if calls and len(sizes) < len(measured):
        note = f"one direction alone takes {max(calls):.0f} us a call at most, nearly all of it Python's\n{note}"
    front_note = f"\n* none is better in both error and time; {result['data']}" if with_error else ""
    return f"{table}\n\n{note}{front_note}"
