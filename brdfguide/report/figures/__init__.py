"""Pictures of measurements, fits and surfaces."""

import logging

# Where matplotlib can keep its fonts is no matter of whoever asked for a picture; it says it while it is imported.
logging.getLogger("matplotlib").setLevel(logging.ERROR)
