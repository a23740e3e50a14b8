"""Options about what a data file means, shared by the commands that read one."""

from typing import Annotated

from typer import Option

from ..errors import InputError

DATA = "Data"
ColumnsOption = Annotated[str | None, Option("--columns", help="Roles of columns, e.g. theta_i=AOI,brdf=value.", rich_help_panel=DATA)]
UnitOption = Annotated[str | None, Option("--unit", help="Unit of the angles: deg or rad.", rich_help_panel=DATA)]
QuantityOption = Annotated[str | None, Option("--quantity", help="brdf, brdf-cos, brdf-cos-i or reflectance-factor.", rich_help_panel=DATA)]
MirrorSideOption = Annotated[str | None, Option("--mirror-side", help="positive, negative, phi=180 or phi=0.", rich_help_panel=DATA)]
WavelengthOption = Annotated[str | None, Option("--wavelength", help="Channels [nm]: 550 or 450,550,650 or 400:700.", rich_help_panel=DATA)]
InPlaneOption = Annotated[bool, Option("--in-plane", help="Only the plane of incidence.", rich_help_panel=DATA)]
ThetaMaxOption = Annotated[float | None, Option("--theta-max", help="Leave out angles beyond this [deg].", rich_help_panel=DATA)]

AveragePhiOption = Annotated[bool, Option("--average-phi-i", help="Average an anisotropic file over the sample's rotation.", rich_help_panel=DATA)]
AnywayOption = Annotated[bool, Option("--anyway", help="Answer also outside the guide and against contradictions.", rich_help_panel=DATA)]


ApertureOption = Annotated[float | None, Option("--aperture-deg", help="Half angle of the detector's cone: include it.", rich_help_panel=DATA)]


def read_examined(data, *options, anyway: bool = False, aperture_deg: float | None = None):
    """As `read`, with the detector's aperture where it is given, with what is certainly wrong undone, spikes left out and every doubt noted; see `inspect`."""
    from .. import examine

    measurement = read(data, *options)
    if aperture_deg is not None:
        from dataclasses import replace

        from ..aperture import solid_angle_of

        measurement = replace(measurement, solid_angle=solid_angle_of(aperture_deg))
    return examine.prepared(measurement, anyway=anyway)


def read(data, *options, **more):
    """The measurement as these options say."""
    from .. import formats

    return formats.read(data, **dict(reading_options(*options, **more)))


def reading_options(columns=None, unit=None, quantity=None, mirror_side=None, wavelength=None, in_plane=False, theta_max=None, average_phi_i=None):
    """The options as keyword arguments of `formats.read`, (name, value) pairs."""
    given = {"columns": columns, "unit": unit, "quantity": quantity, "mirror_side": mirror_side, "average_phi_i": average_phi_i}
    selection = {"wavelength": wavelengths(wavelength), "in_plane": in_plane, "theta_max": theta_max}
    return tuple((name, value) for name, value in {**given, **selection}.items() if value is not None)


def wavelengths(text: str | None):
    """`450,550` as a list [nm], `400:700` as a range; None stays None. Raises InputError."""
    if text is None:
        return None
    try:
        if ":" in text:
            low, high = (float(part) for part in text.split(":"))
            return low, high
        return [float(part) for part in text.split(",")]
    except ValueError:
        raise InputError(f"--wavelength {text}: wanted nanometres such as 550, 450,550,650 or 400:700") from None
