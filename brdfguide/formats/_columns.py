"""What the columns of a table mean: role, unit, wavelength and quantity out of a name such as `BRDF [1/sr] 550 nm`."""

import re
from dataclasses import dataclass, replace

# Each pattern is met by the name in lower case without unit, brackets, spaces and punctuation.
_IN = "(i|0|in|inc|incident|incidence|incoming|l|light|illum|illumination|illuminant|source|lamp|wi|input|sun|solar)"
_OUT = (
    "(r|o|s|v|e|out|outgoing|output|scat|scatter|scattered|scattering|ref|refl|reflected|reflection|reflect|view|viewing|viewer|det|detector"
    "|obs|observer|observation|receiver|camera|sensor|exit|exitance|emission|emergence|emergent|meas|measure|measured|measurement|wo)"
)
_POLAR, _AZIMUTH = "(theta|polar|zenith|angle|elevationfromnormal)", "(phi|azimuth|azimuthal|azi|az)"
_POLAR_END = "(angle|theta|polar|polarangle|zenith|zenithangle|deg)?"
_AZIMUTH_END = "(azimuth|azimuthangle|azimuthal|azimuthalangle|phi|az)"
ROLES = {
    "theta_i": rf"{_POLAR}{_IN}(angle)?|{_IN}{_POLAR_END}(?<!^i)(?<!^l)(?<!^in)|aoi|angleof({_IN})|sza|ti|thi|{_POLAR}of{_IN}",
    "theta_r": rf"{_POLAR}{_OUT}(angle)?|{_OUT}{_POLAR_END}(?<!^r)(?<!^o)(?<!^s)(?<!^v)(?<!^e)|angleof({_OUT})|vza|tr|to|thr|aos|aor|{_POLAR}of{_OUT}",
    "phi_i": rf"{_AZIMUTH}(angle)?{_IN}(angle)?|{_IN}{_AZIMUTH_END}|saa|pi|poi",
    "phi_r": rf"{_AZIMUTH}(angle)?{_OUT}(angle)?|{_OUT}{_AZIMUTH_END}|vaa|pr|po",
    "dphi": r"(d|delta|rel|relative)(phi|azimuth|azimuthangle|az)|phi(d|diff|difference|rel|relative)|azimuth(d|diff|difference|rel|relative)|raa|(phi|azimuth|azimuthal|az|azi)(angle)?",
    "wavelength": r"wavelength|wavelen|wl|wave|lambda|lam|lambda0|wavelengths",
    "stderr": r"(stderr|stderror|standarderror|se|std|stdev|stddev|sd|sigma|u|unc|uncertainty|uncert|error|err|delta|d|sem)(brdf|fr|f|bsdf|value)?"
    r"|(brdf|fr|f|bsdf|value)(stderr|stderror|standarderror|se|std|stdev|stddev|sd|sigma|u|unc|uncertainty|uncert|error|err)"
    r"|(brdf|fr|f|bsdf)?(rel|relative|expanded|combined|standard|absolute|abs|total)+(unc|uncertainty|uncert|error|err|stddev)(brdf|fr|f|bsdf)?(k[123])?"
    r"|(brdf|fr|f|bsdf)?(unc|uncertainty|uncert|error)k[123]",
    "value": r"(brdf|bsdf|fr|f|fs|fr11|brdfr|value|values|val|brdfvalue|bsdfvalue|measuredbrdf|meanbrdf|brdfmean|bidirectionalreflectancedistributionfunction"
    r"|brdfcos|brdfcostheta|brdfcosthetar|brdfcosthetao|brdfxcos|brdfxcostheta|brdftimescos|ccbrdf|ccbsdf|bsdfcos|frcos|fcos|cosbrdf"
    r"|cosinecorrectedbrdf|cosinecorrectedbsdf|cosineweightedbrdf|dsf|ars|angleresolvedscatter|angleresolvedscattering"
    r"|reflectancefactor|brf|rf|hcrf|bicrf|radiancefactor|pibrdf|brdfpi|brdfxpi|reflectance|intensity)",
}
QUANTITY = {
    "brdf-cos": (
        r"(brdf|bsdf|fr|f)(x|times)?cos(theta)?[ro]?|cosbrdf|cc(brdf|bsdf)|cosine(corrected|weighted)(brdf|bsdf)|dsf|ars|angleresolvedscatter(ing)?"
    ),
    "reflectance-factor": r"reflectancefactor|brf|rf|hcrf|bicrf|radiancefactor|pibrdf|brdf(x)?pi",
}
COLOURS = {"r": "R", "red": "R", "g": "G", "green": "G", "b": "B", "blue": "B", "x": "X", "y": "Y", "z": "Z"}
UNITS = {
    "deg": "deg", "degs": "deg", "degree": "deg", "degrees": "deg", "°": "deg", "rad": "rad", "rads": "rad", "radian": "rad", "radians": "rad",
    "nm": "nm", "nanometer": "nm", "nanometers": "nm", "nanometre": "nm", "nanometres": "nm", "um": "um", "µm": "um", "micron": "um", "microns": "um",
    "micrometer": "um", "micrometre": "um", "micrometers": "um", "micrometres": "um", "mm": "mm", "m": "m", "%": "%", "percent": "%",
}  # fmt: skip
TO_UM = {"nm": 1e-3, "um": 1.0, "mm": 1e3, "m": 1e6}
PER_SR = re.compile(r"(1|in|inv)?(per)?sr1?$")
GREEK = {"θ": "theta", "ϑ": "theta", "φ": "phi", "ϕ": "phi", "λ": "lambda", "μ": "µ", "σ": "sigma", "δ": "delta", "Δ": "delta", "π": "pi"}


@dataclass(frozen=True)
class Column:
    """One column as its name says: `role` is None where the name says nothing."""

    name: str
    place: int
    role: str | None
    unit: str | None = None
    channel: str | None = None  # name of the colour or wavelength that the column holds
    um: float | None = None
    quantity: str | None = None


def understood(name: str, place: int) -> Column:
    """What a column's name says."""
    key, unit = _key_and_unit(name)
    um = _wavelength(name)
    if um is not None:
        base, _ = _key_and_unit(re.sub(r"[=@:]*\s*\d+(\.\d+)?[\s_]*(nm|um|µm|microns?)?$", "", _flat(name).rstrip(")]} ")))
        base = "" if _is("wavelength", base) else base
        role = "stderr" if base and _is("stderr", base) else "value" if not base or _is("value", base) else None
        return Column(name, place, role, None, f"{um * 1000:g}nm", um, _quantity(base))
    if "cos" in key or re.search(r"cos\W*theta", _flat(name)):
        if re.search(r"brdf|bsdf|\bf_?r\b", _flat(name)):
            return Column(name, place, "value", quantity="brdf-cos")
    colour, rest = _colour(name)
    if colour and (not rest or _is("value", rest) or _is("stderr", rest)):
        role = "stderr" if rest and _is("stderr", rest) else "value"
        return Column(name, place, role, None, colour, None, _quantity(rest))
    return Column(name, place, role_of(key), unit, quantity=_quantity(key))


def role_of(key: str) -> str | None:
    return next((role for role in ROLES if _is(role, key)), None)


def _is(role: str, key: str) -> bool:
    """Whether a name has this role; the pattern is compiled when first asked for, since most files need few of them."""
    return re.fullmatch(ROLES[role], key) is not None


def table(names: list[str]) -> list[Column]:
    """What all names say together: a lone `f_r` is no red channel, a lone `theta` is the other angle."""
    columns = [understood(name, place) for place, name in enumerate(names)]
    colours = {column.channel for column in columns if column.role == "value" and column.channel}
    for place, column in enumerate(columns):
        if column.channel in COLOURS.values() and not ({"R", "G", "B"} <= colours or {"X", "Y", "Z"} <= colours or column.channel == "Y"):
            key, unit = _key_and_unit(column.name)
            columns[place] = Column(column.name, place, role_of(key), unit, quantity=_quantity(key))
    columns = _pairs_of_letters(columns)
    roles = {column.role for column in columns}
    for place, column in enumerate(columns):
        key, unit = _key_and_unit(column.name)
        if key in ("theta", "polar", "angle", "zenith", "polarangle", "zenithangle") and "theta_r" not in roles:
            columns[place] = Column(column.name, place, "theta_r", unit)
    return columns


def _pairs_of_letters(columns: list[Column]) -> list[Column]:
    """`i, e` are incidence and emergence; beside `theta_v`, `theta_s` is the source's."""
    keys = [_key_and_unit(column.name)[0] for column in columns]
    meant = {}
    if "i" in keys and len({"e", "r", "o", "v", "s"} & set(keys)) == 1:
        meant = {"i": "theta_i", **dict.fromkeys("erovs", "theta_r")}
    for polar, role in (("theta", "theta"), ("phi", "phi")):
        if polar + "s" in keys and polar + "v" in keys and f"{role}_i" not in {column.role for column in columns}:
            meant[polar + "s"] = f"{role}_i"
    return [replace(column, role=meant[key], channel=None) if key in meant else column for column, key in zip(columns, keys)]


def _flat(name: str) -> str:
    return "".join(GREEK.get(letter, letter) for letter in name.strip().strip("\"'").lower())


def _key_and_unit(name: str):
    """The name without unit and punctuation, and the unit."""
    flat, unit = _flat(name), None
    for bracket in re.findall(r"[\[({]([^\])}]*)[\])}]", flat):
        inside = bracket.strip().replace(" ", "")
        unit = UNITS.get(inside, unit)
        if inside not in UNITS and not PER_SR.fullmatch(_bare(inside)):
            flat = flat.replace(bracket, bracket.replace(" ", ""))
            continue
        flat = flat.replace(bracket, "")
    words = [word for word in re.split(r"[\s_\-./:,;*×()\[\]{}^]+", flat) if word]
    while len(words) > 1 and words[-1] in UNITS:
        unit = unit or UNITS[words.pop()]
    if words and words[-1].endswith("°"):
        unit, words[-1] = unit or "deg", words[-1].rstrip("°")
    key = "".join(_bare(word) for word in words)
    return PER_SR.sub("", key) if key[:4] in ("brdf", "bsdf", "valu") or key.startswith("fr") else key, unit


def _bare(text: str) -> str:
    return re.sub(r"[^a-z0-9]", "", text)


def _wavelength(name: str) -> float | None:
    """Micrometres of a column named for its wavelength: `550nm`, `brdf_0.55um`, `550`."""
    flat = re.sub(r"[\[\](){}]", " ", _flat(name)).strip()
    if found := re.search(r"(?:^|[^0-9.])(\d+(?:\.\d+)?)[\s_]*(nm|um|µm|microns?)$", flat):
        return float(found[1]) * TO_UM[UNITS[found[2]]]
    if found := re.fullmatch(r"(?:(?:brdf|bsdf|fr|f|value|wl|lambda|lam|wavelength)[\s_=@:]*)?(\d+(?:\.\d+)?)", flat):
        number = float(found[1])
        if 100 <= number <= 20000:
            return number / 1000
        if 0.1 <= number <= 30 and "." in flat:
            return number
    return None


def _colour(name: str):
    words = [word for word in re.split(r"[\s_\-.:,;\[\]()]+", _flat(name)) if word and word not in ("1/sr", "sr^-1")]
    for place in (-1, 0):
        if words and words[place] in COLOURS:
            rest = words[:-1] if place == -1 else words[1:]
            return COLOURS[words[place]], PER_SR.sub("", "".join(_bare(word) for word in rest))
    return None, ""


def _quantity(key: str) -> str | None:
    return next((quantity for quantity, pattern in QUANTITY.items() if key and re.fullmatch(pattern, key)), None)
