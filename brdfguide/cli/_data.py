"""Options about what a data file means, shared by the commands that read one."""

from math import isfinite
from typing import Annotated, Any

from typer import Option

from ..errors import InputError
from ..records import dataclass

PANEL = "Data"


@dataclass(frozen=True, eq=False, kw_only=True)
class Reading:
    """What a file's columns, angles and values mean, and which of them are taken."""

    wavelength: Annotated[
        str | None, Option("--wavelength", help="Channels [nm]: 550 or 450,550,650 or 400:700.", rich_help_panel=PANEL)
    ] = None
    in_plane: Annotated[bool, Option("--in-plane", help="Only the plane of incidence.", rich_help_panel=PANEL)] = False
    theta_max: Annotated[
        float | None, Option("--theta-max", help="Leave out angles beyond this [deg].", rich_help_panel=PANEL)
    ] = None
    columns: Annotated[
        str | None, Option("--columns", help="Roles of columns, e.g. theta_i=AOI,brdf=value.", rich_help_panel=PANEL)
    ] = None
    unit: Annotated[
        str | None, Option("--unit", help="Unit of the angles: deg, rad, gon, mrad, arcmin.", rich_help_panel=PANEL)
    ] = None
    quantity: Annotated[
        str | None,
        Option(
            "--quantity",
            help="brdf, brdf-cos, brdf-cos-i, reflectance-factor (brf), hdrf or radf (I/F).",
            rich_help_panel=PANEL,
        ),
    ] = None
    wavelength_nm: Annotated[
        float | None,
        Option("--wavelength-nm", help="Wavelength of a file that does not state it [nm].", rich_help_panel=PANEL),
    ] = None
    select: Annotated[
        list[str] | None,
        Option("--select", help="Only the rows of a table that have it: sample=white.", rich_help_panel=PANEL),
    ] = None
    mirror_side: Annotated[
        str | None, Option("--mirror-side", help="positive, negative, phi=180 or phi=0.", rich_help_panel=PANEL)
    ] = None
    average_phi_i: Annotated[
        bool,
        Option(
            "--average-phi-i", help="Average an anisotropic file over the sample's rotation.", rich_help_panel=PANEL
        ),
    ] = False

    rotation_sense: Annotated[
        str | None,
        Option("--rotation-sense", help="In which sense the sample was turned: ccw or cw.", rich_help_panel=PANEL),
    ] = None
    scale: Annotated[float | None, Option("--scale", help="Multiply all values by this.", rich_help_panel=PANEL)] = None

    def options(self) -> dict[str, Any]:
        """Keyword arguments of `formats.read`. Raises InputError for a wavelength that is no number."""
        given = {
            "columns": self.columns,
            "unit": self.unit,
            "quantity": self.quantity,
            "mirror_side": self.mirror_side,
            "average_phi_i": self.average_phi_i,
            "rotation_sense": self.rotation_sense,
            "scale": self.scale,
            "wavelength_nm": self.wavelength_nm,
            "select": tuple(self.select) if self.select else None,
            "wavelength": wavelength_choice(self.wavelength),
            "in_plane": self.in_plane,
            "theta_max": self.theta_max,
        }
        return {name: value for name, value in given.items() if value is not None}


ApertureOption = Annotated[
    float | None, Option("--aperture-deg", help="Half angle of the detector's cone: include it.", rich_help_panel=PANEL)
]
AnywayOption = Annotated[
    bool, Option("--anyway", help="Answer also outside the guide and against contradictions.", rich_help_panel=PANEL)
]


TurnedOption = Annotated[
    str | None,
    Option(
        "--turned",
        help="The files, or the values of a column `scan`, are one sample turned by these angles [deg]: 0,90.",
        rich_help_panel=PANEL,
    ),
]


def wavelength_choice(text: str | None) -> tuple[float, float] | list[float] | None:
    """`450,550` as a list [nm], `400:700` as a range; None stays None. Raises InputError."""
    if text is None:
        return None
    try:
        asked = [float(part) for part in text.split(":" if ":" in text else ",")]
        if not all(map(isfinite, asked)):
            raise ValueError
        if ":" not in text:
            return asked
        low, high = asked
        return low, high
    except ValueError:
        raise InputError(f"--wavelength {text}: wanted nanometres such as 550, 450,550,650 or 400:700") from None
