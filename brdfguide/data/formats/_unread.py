"""Files that are not read, known by their first bytes, and what to export instead."""

import re

AS_CSV = "export a table of theta_i, phi_i, theta_r, phi_r and BRDF as CSV"
OPTIS = re.compile(rb"\s*OPTIS - ([A-Za-z ]{3,40}?) (?:surface )?file\b", re.IGNORECASE)
INTEGRA = ("Source", "TypeSym", "TypeColorModel", "TypeData")  # words that its first lines begin with
WIDE_LETTERS = rb"(?:\xff\xfe\0\0|\0\0\xfe\xff)?(?:(?:[\t\n\r -~]\0{1,3}){6}|(?:\0{1,3}[\t\n\r -~]){6})"
# first bytes as a pattern, what such a file is, what to do instead
KINDS = (
    (WIDE_LETTERS, "text in UTF-32", "save it as UTF-8"),
    (rb"\xd0\xcf\x11\xe0", "an Excel workbook of before 2007 (.xls)", "save it as .xlsx or as CSV"),
    (rb"PK\x03\x04.{26}mimetypeapplication/vnd\.oasis", "an OpenDocument text", "save its table as .ods or CSV"),
    (rb"PK\x03\x04", "a ZIP archive", "unpack it and give the file inside"),
    (rb"\x28\xb5\x2f\xfd", "a file packed by Zstandard", "unpack it with `unzstd`"),
    (rb"\x5d\0\0.{2}[\0\xff]", "a file packed by LZMA", "unpack it with `unlzma`, or pack it as .xz"),
    (rb"\x04\x22\x4d\x18", "a file packed by LZ4", "unpack it with `unlz4`"),
    (rb"7z\xbc\xaf\x27\x1c", "a 7z archive", "unpack it and give the file inside"),
    (rb"Rar!\x1a\x07", "a RAR archive", "unpack it and give the file inside"),
    (rb".{257}ustar", "a tar archive", "unpack it and give the file inside"),
    (rb"CDF[\x01\x02\x05]", "a NetCDF file", AS_CSV),
    (rb"MATLAB (?:5\.0|7\.3) MAT-file", "a MATLAB file", "write its table with writematrix or writetable as CSV"),
    (rb"\x93NUMPY", "a NumPy array", "write it with numpy.savetxt and a header that names the columns"),
    (rb"%PDF-", "a PDF document", AS_CSV),
    (rb"\x89PNG\r\n|\xff\xd8\xff|II\*\0|MM\0\*|\x76\x2f\x31\x01", "a picture", AS_CSV),
    (rb"glTF", "a glTF scene", AS_CSV),
    (rb"AxF", "an X-Rite AxF appearance", AS_CSV),
    (rb"IESNA", "an IES photometry of a lamp", "it holds the lamp's light, not a surface's reflection"),
    (rb"\s*##TITLE=", "a JCAMP-DX spectrum", "it holds no angles; export the goniometer's table as CSV"),
    (rb"\s*(?:<!DOCTYPE html|<html)", "a web page without a table", "download the file that the page links to"),
    (rb"\s*(?:<\?xml|<!--).{0,2000}<materialx\b", "a MaterialX document", "it holds shaders, no measured values"),
    (rb"\s*<\?xml|\s*<[A-Za-z]{3,}[ >]", "XML of another kind", AS_CSV),
    (rb'\s*\[\s*(?:[\[{"\d]|$)|\s*\{\s*\}', "JSON of another kind", AS_CSV),
    (rb"version https://git-lfs", "the pointer to a file in Git LFS, not the file", "fetch it with `git lfs pull`"),
    (rb"\{\\rtf", "a document of a word processor", "save it as plain text"),
)  # fmt: skip


def what_instead(head: bytes) -> str | None:
    """What the file is and what to do instead, or None where nothing here knows it."""
    if match := OPTIS.match(head):
        kind = match[1].decode("latin-1").strip().lower()
        text = f"this is a Speos '{kind}' file: it holds a model's parameters or totals, no table of directions"
        return f"{text}; export a .brdf or an .anisotropicbsdf as text"
    begins = _first_words(head)
    if begins[:1] == ["VERSION"]:
        return f"this is Surface Scattering Distribution Data (.ssdd), which is not read; {AS_CSV}"
    if len(begins) == 2 and set(begins) <= set(INTEGRA) and begins != ["Source", "Source"]:
        return f"this is an Integra distribution (.ddr, .ddt, .sdr, .sdt), which is not read; {AS_CSV}"
    for pattern, what, instead in KINDS:
        if re.match(pattern, head, re.DOTALL):
            return f"this is {what}, which is not read; {instead}"
    return None


def _first_words(head: bytes) -> list[str]:
    """The first words of the first two lines that are no comments, where another word follows each."""
    found: list[str] = []
    for line in head[:4096].decode("latin-1").splitlines():
        words = line.split()
        if words and not words[0].startswith(("#", ";")):
            found.append(words[0] if len(words) > 1 else "")
        if len(found) == 2:
            break
    return found
