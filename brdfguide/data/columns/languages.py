"""Heads in other languages, as the English words of the vocabulary; docs/columns.md is written from these tables."""

import re

from .tokens import Token
from .vocabulary import SPELT, SPELT_ALONE

# a word between blanks -> what it is here; nothing where the word beside it says all
WORDS = {
    "German": {
        "winkel": "angle",
        "einfallswinkel": "angle of incidence",
        "einstrahlwinkel": "angle of incidence",
        "ausfallswinkel": "angle of reflection",
        "reflexionswinkel": "angle of reflection",
        "streuwinkel": "scatter angle",
        "beobachtungswinkel": "viewing angle",
        "detektorwinkel": "detector angle",
        "azimut": "azimuth",
        "azimutwinkel": "azimuth angle",
        "wellenlänge": "wavelength",
        "wellenlaenge": "wavelength",
        "unsicherheit": "uncertainty",
    },
    "French": {
        "incidente": "incident",
        "réflexion": "reflection",
        "reflexion": "reflection",
        "réfléchi": "reflected",
        "diffusion": "scattering",
        "diffusé": "scattered",
        "éclairement": "illumination",
        "éclairage": "illumination",
        "visée": "viewing",
        "émergence": "emergence",
        "détecteur": "detector",
        "zénithal": "zenith",
        "zénital": "zenith",
        "azimutal": "azimuth",
        "longueur": "",
        "onde": "wavelength",
        "incertitude": "uncertainty",
        "degrés": "degrees",
        "degré": "degrees",
        "du": "of",
        "de": "of",
        "fdrb": "brdf",
    },
    "Spanish": {
        "ángulo": "angle",
        "angulo": "angle",
        "incidencia": "incidence",
        "reflexión": "reflection",
        "dispersión": "scattering",
        "observación": "observation",
        "iluminación": "illumination",
        "cenital": "zenith",
        "acimut": "azimuth",
        "acimutal": "azimuth",
        "longitud": "",
        "onda": "wavelength",
        "incertidumbre": "uncertainty",
        "grados": "degrees",
        "del": "of",
    },
    "Italian": {
        "angolo": "angle",
        "incidenza": "incidence",
        "riflessione": "reflection",
        "diffusione": "scattering",
        "osservazione": "observation",
        "illuminazione": "illumination",
        "zenitale": "zenith",
        "azimutale": "azimuth",
        "lunghezza": "",
        "incertezza": "uncertainty",
        "gradi": "degrees",
        "di": "of",
    },
    "Portuguese": {
        "ângulo": "angle",
        "incidência": "incidence",
        "reflexão": "reflection",
        "espalhamento": "scattering",
        "observação": "observation",
        "iluminação": "illumination",
        "comprimento": "",
        "incerteza": "uncertainty",
        "graus": "degrees",
    },
    "Dutch": {
        "hoek": "angle",
        "invalshoek": "angle of incidence",
        "uitvalshoek": "angle of reflection",
        "strooihoek": "scatter angle",
        "golflengte": "wavelength",
        "onzekerheid": "uncertainty",
        "graden": "degrees",
    },
    "Swedish": {
        "infallsvinkel": "angle of incidence",
        "reflektionsvinkel": "angle of reflection",
        "spridningsvinkel": "scatter angle",
        "våglängd": "wavelength",
        "osäkerhet": "uncertainty",
    },
    "Polish": {
        "kąt": "angle",
        "padania": "incidence",
        "odbicia": "reflection",
        "rozproszenia": "scattering",
        "obserwacji": "observation",
        "długość": "",
        "fali": "wavelength",
        "niepewność": "uncertainty",
    },
    "Russian": {
        "угол": "angle",
        "падения": "incidence",
        "отражения": "reflection",
        "рассеяния": "scattering",
        "наблюдения": "observation",
        "освещения": "illumination",
        "зенитный": "zenith",
        "азимут": "azimuth",
        "азимутальный": "azimuth",
        "длина": "",
        "волны": "wavelength",
        "погрешность": "uncertainty",
        "неопределенность": "uncertainty",
        "неопределённость": "uncertainty",
        "град": "degrees",
        "градусы": "degrees",
        "дфос": "brdf",
    },
}
# the same of scripts without blanks between words
SIGNS = {
    "Chinese": {
        "双向反射分布函数": "brdf",
        "雙向反射分佈函數": "brdf",
        "双向散射分布函数": "bsdf",
        "雙向散射分佈函數": "bsdf",
        "反射率因子": "reflectance factor",
        "反射因子": "reflectance factor",
        "反射率": "reflectance",
        "不确定度": "uncertainty",
        "不確定度": "uncertainty",
        "标准差": "std",
        "標準差": "std",
        "波长": "wavelength",
        "波長": "wavelength",
        "入射": "incident",
        "出射": "exit",
        "反射": "reflection",
        "散射": "scattering",
        "观测": "viewing",
        "觀測": "viewing",
        "观察": "viewing",
        "探测": "detector",
        "天顶": "zenith",
        "天頂": "zenith",
        "方位": "azimuth",
        "相对": "relative",
        "相對": "relative",
        "弧度": "radians",
        "角度": "angle",
        "角": "angle",
        "度": "degrees",
    },
    "Japanese": {
        "双方向反射率分布関数": "brdf",
        "双方向反射分布関数": "brdf",
        "不確かさ": "uncertainty",
        "標準偏差": "std",
        "受光": "detector",
        "散乱": "scattering",
        "観測": "viewing",
        "相対": "relative",
    },
    "Korean": {
        "불확도": "uncertainty",
        "파장": "wavelength",
        "입사": "incident",
        "반사": "reflection",
        "산란": "scattering",
        "관측": "viewing",
        "천정": "zenith",
        "방위": "azimuth",
        "각도": "angle",
        "각": "angle",
    },
}
ENGLISH_OF = {word: english for table in WORDS.values() for word, english in table.items()}
PLAIN = SPELT | ENGLISH_OF
PLAIN_ALONE = PLAIN | SPELT_ALONE  # of a name of nothing but two letters
_SIGNS = {word: english for table in SIGNS.values() for word, english in table.items()}
_LONGEST_FIRST = "|".join(sorted(_SIGNS, key=len, reverse=True))
_SIGN = re.compile(_LONGEST_FIRST)
_WORD = re.compile(r"[^\W\d_]+")
_APOSTROPHES = frozenset("'’")
# of text that is no UTF-8, likeliest first: where none of them makes more known words the first is right
ENCODINGS = ("latin-1", "gb18030", "shift_jis", "cp1251", "cp1250", "big5", "euc_kr")
LOOKED_AT = 2**14  # bytes; heads come first


def with_blanks(text: str) -> str:
    """A name or a line with English words for those of scripts that have no blanks between them."""
    return text if text.isascii() else _SIGN.sub(lambda found: f" {_SIGNS[found[0]]} ", text)


def without_articles(found: list[Token]) -> list[Token]:
    """Without the d and l before an apostrophe: `angle d'incidence`."""
    if not any(token.text in _APOSTROPHES for token in found):
        return found
    dropped = {
        place
        for at, token in enumerate(found)
        if token.text in _APOSTROPHES and at and found[at - 1].text in ("d", "l")
        for place in (at - 1, at)
    }
    return [token for place, token in enumerate(found) if place not in dropped]


def encoding_of(data: bytes | bytearray) -> str:
    """That of text which is no UTF-8: the one in which the most of its words are known here, else Latin-1."""
    head = bytes(data[:LOOKED_AT])
    return max(ENCODINGS, key=lambda encoding: _known_letters(head.decode(encoding, "replace")))


def _known_letters(text: str) -> int:
    """How many letters beyond ASCII stand in words that are known."""
    words = [word for word in _WORD.findall(text) if not word.isascii()]
    signs = sum(len(sign) for word in words for sign in _SIGN.findall(word) if len(sign) > 1)
    return signs + sum(len(word) for word in words if word.lower() in ENGLISH_OF)
