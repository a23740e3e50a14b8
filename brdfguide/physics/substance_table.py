"""What things are made of: n and k by name, with wavelength and source, and how far a stand-in may be off.

The report's Table 1 with the wavelength of each row, the coloured metals that break its rule of one index over the
spectrum, and common dielectrics; what things about the house are made of stands in `more_substances`.
"""

from ..records import dataclass

READ_AT_UM = (0.65, 0.55, 0.45)  # where the tables of coloured metals were read; see `colour.SRGB_UM`
JC72 = "Johnson and Christy 1972, Phys. Rev. B 6, 4370, interpolated at 650, 550, 450 nm"
JC74 = "Johnson and Christy 1974, Phys. Rev. B 9, 5056, interpolated at 650, 550, 450 nm"
QUERRY = "Querry 1985, report CRDC-CR-85034, Cu70Zn30, interpolated at 650, 550, 450 nm"
RAKIC = "Rakić et al. 1998, Appl. Opt. 37, 5271, Brendel and Bormann's model, at 650, 550, 450 nm"
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


def dielectric(name, n, wavelength, source, *aliases, table1=None, note="") -> Substance:
    """A substance without absorption, its index at one wavelength [µm]."""
    return Substance(
        name, "dielectric", (n,), (0.0,), None if wavelength is None else (wavelength,), source, aliases, table1, note
    )


def metal(name, n, k, wavelength, source, *aliases, table1=None, note="") -> Substance:
    """A metal, its n and k at each wavelength [µm]."""
    return Substance(name, "metal", n, k, wavelength, source, aliases, table1, note)


GHOSH = "Ghosh 1999, Opt. Commun. 163, 95"
# These four rest on memory: a search found the first three works but none of their pages, and no trace of Laurie's.
HANDBOOK = "from memory of Brandrup, Immergut and Grulke 1999, Polymer Handbook, 4th ed., page not seen"
DE_LA_RIE = "from memory of de la Rie 1987, Stud. Conserv. 32, 1, page not seen"
KINGERY = "from memory of Kingery, Bowen and Uhlmann 1976, Introduction to Ceramics, 2nd ed., page not seen"
LAURIE = "from memory of Laurie 1937, Proc. R. Soc. A 159, 123, page not seen"
ZHANG = "Zhang et al. 2020, Appl. Opt. 59, 2337"
GEMOLOGY_PROJECT = "The Gemology Project, as quoted in POV-Ray's ior.inc"
GEMMOLOGY_DEV = "gemmology-dev's table of refractive indices (GitHub, gemmology-plugin)"
RENDERERS = "lists of indices for renderers, which name no measurement"
SODIUM = 0.5893  # µm, the line that handbooks give indices for
TABLE1 = "Westin et al. 2004, Table 1: "
FIRST_SUBSTANCES = (
    dielectric(
        "water",
        1.34,
        0.55,
        TABLE1 + "Segelstein 1981",
        table1=0.0211,
        note="tables more often give 1.333 to 1.335 at 550 nm, F0 3 % lower",
    ),
    dielectric("fused silica", 1.460, 0.546074, TABLE1 + "Palik 1985", "silica", "pure glass", table1=0.0350),
    dielectric(
        "acrylic",
        1.48,
        0.55,
        TABLE1 + "their measurement",
        "lucite",
        "plexiglas",
        "pmma",
        "perspex",
        table1=0.0375,
        note="1.49 is usual, F0 3 % higher",
    ),
    dielectric("polyethylene", 1.490, 0.5511, TABLE1 + "Palik 1985", "pe", "hdpe", "ldpe", table1=0.0387),
    dielectric(
        "window glass",
        1.51,
        0.55,
        TABLE1 + "Brown 1985, the lower of 1.51 to 1.54",
        "glass",
        "plate glass",
        "float glass",
        table1=0.0413,
    ),
    dielectric("window glass (high)", 1.54, 0.55, TABLE1 + "Brown 1985, the higher of 1.51 to 1.54", table1=0.0452),
    dielectric("diamond", 2.4203, 0.55, TABLE1 + "Palik 1985", table1=0.1724),
    metal("nickel", (1.80,), (3.33,), (0.5636,), TABLE1 + "Palik 1985", table1=0.6196),
    metal("chromium", (3.18,), (4.41,), (0.5585,), TABLE1 + "Palik 1998", "chrome", table1=0.6555),
    metal(
        "aluminium",
        (0.958,),
        (6.69,),
        None,
        TABLE1 + "Palik 1985",
        "aluminum",
        "aluminium alloy",
        "duralumin",
        "cast aluminium",
        table1=0.9211,
        note="row printed without a wavelength, under a caption that says 550 nm; stands for its alloys too, while "
        "seven authors of the pure metal differ by 1 % in F0",
    ),
    metal(
        "silver",
        (0.120,),
        (3.45,),
        None,
        TABLE1 + "Palik 1985",
        table1=0.9635,
        note="row printed without a wavelength, under a caption that says 550 nm",
    ),
    metal("gold", (0.156, 0.424, 1.383), (3.602, 2.472, 1.916), READ_AT_UM, JC72),
    metal("copper", (0.238, 1.007, 1.240), (3.626, 2.582, 2.393), READ_AT_UM, JC72),
    metal(
        "brass",
        (0.444, 0.527, 1.094),
        (3.695, 2.765, 1.829),
        READ_AT_UM,
        QUERRY,
        "cartridge brass",
        "yellow brass",
        "cuzn30",
        note="30 % zinc; grades with 15 and 10 % have 6 % less F0 at 550 nm",
    ),
    metal(
        "iron",
        (2.911, 2.950, 2.585),
        (3.089, 2.932, 2.767),
        READ_AT_UM,
        JC74,
        "steel",
        "cast iron",
        "mild steel",
        "carbon steel",
        note="stands for plain steel, as in the report's section 4.4; another author's iron has 11 % more F0 at 550 nm",
    ),
    metal(
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
        note="one steel stands for 304 and 316; the ferritic one beside it has 8 % less F0 at 550 nm",
    ),
    metal(
        "ferritic stainless steel",
        (2.194, 1.904, 1.494),
        (3.481, 3.170, 2.771),
        READ_AT_UM,
        KARLSSON,
        "430",
        "430 stainless steel",
        note="one steel stands for all ferritic grades; the austenitic one beside it has 9 % more F0 at 550 nm",
    ),
    metal("tungsten", (3.671, 3.522, 3.315), (2.932, 2.741, 2.516), READ_AT_UM, WEAVER),
    metal("molybdenum", (3.450, 3.470, 2.840), (3.670, 3.560, 3.510), READ_AT_UM, KIRILLOVA),
    metal("titanium", (2.741, 2.542, 2.267), (3.814, 3.435, 3.039), READ_AT_UM, JC74),
    metal("cobalt", (2.237, 2.052, 1.737), (4.236, 3.824, 3.275), READ_AT_UM, JC74),
    metal("platinum", (2.376, 2.085, 1.845), (4.265, 3.715, 3.136), READ_AT_UM, RAKIC),
    metal(
        "zinc",
        (1.234, 0.929, 0.678),
        (5.873, 4.975, 4.012),
        READ_AT_UM,
        WERNER,
        "galvanised steel",
        note="authors differ: F0 at 550 nm from 0.77 to 0.87, this one's the highest",
    ),
    Substance(
        "silicon",
        "semiconductor",
        (3.844, 4.077, 4.691),
        (0.0144, 0.028, 0.0863),
        READ_AT_UM,
        "Green 2008, Sol. Energy Mater. Sol. Cells 92, 1305",
    ),
    dielectric("polystyrene", 1.596, 0.55, SULTANOVA, "ps"),
    dielectric("polycarbonate", 1.589, 0.55, SULTANOVA, "pc", "lexan", "makrolon"),
    dielectric("cellulose", 1.472, 0.55, SULTANOVA, "cellophane"),
    dielectric("rutile", 2.648, 0.55, DEVORE, "titanium dioxide", note="the ordinary ray; white pigment"),
    dielectric("ice", 1.3098, None, PB),
    dielectric("soda-lime glass", 1.52, None, PB, "soda lime glass"),
    dielectric("pet", 1.575, None, PB, "polyester"),
    dielectric("polyurethane", 1.6, None, PB, "pur"),
    dielectric("quartz", 1.54, None, PB, "amethyst", "citrine", "rock crystal"),
    dielectric("salt", 1.5441, None, PB),
    dielectric("sapphire", 1.7682, None, PB, "ruby", "corundum"),
    dielectric("cooking oil", 1.47, None, PB, "oil"),
    dielectric("milk", 1.348, None, PB, "cream"),
    dielectric("skin", 1.4, None, PB),
    dielectric("blood", 1.35, None, PB),
    dielectric("honey", 1.504, None, PB),
    dielectric("pearl", 1.68, None, PB),
    dielectric("juice", 1.3325, None, PB, "cola", "white wine", "wine"),
    metal("magnesium", (0.2864, 0.3223, 0.5948), (6.756, 4.949, 4.252), None, PB_RGB),
    metal("beryllium", (3.210, 3.329, 3.771), (3.298, 3.117, 2.670), None, PB_RGB),
    metal("vanadium", (3.651, 3.727, 4.946), (3.251, 3.007, 2.179), None, PB_RGB),
    dielectric("ptfe", 1.35, None, PB + ", its Spectralon", "teflon", "spectralon"),
)
