"""The plan for a surface of which nothing is known, learnt from tables of measured surfaces.

Before any data a plan is the same for every surface, so it need not be derived anew. These were found by exchange
(`benchmarks/plan_learnt.py`): beginning with general plans (`planning.plan_everywhere`), one direction after another
was replaced where nine laws, fitted to the rows of nine given tables nearest to the directions, came nearer to their
fits to the whole tables, as the plan is and with every angle moved by about two degrees; out of the plane 25 made
tables counted as well. What they reach there, and on made tables that they were not learnt from, is told in
`docs/out_of_plane.md`.
"""

import numpy as np

from ..physics.geometry import Geometry, rows

# theta_i, theta_r, phi_r - phi_i [deg]; the mirror side at 180
EIGHT_DEG = (
    (14, 3, 130),
    (41, 39, 180),
    (56, 24, 76),
    (70, 43, 172),
    (28, 28, 180),
    (67, 63, 178),
    (69, 50, 145),
    (75, 51, 88),
)
SIXTEEN_DEG = (
    *EIGHT_DEG,
    (74, 66, 175),
    (79, 38, 12),
    (65, 7, 91),
    (10, 8, 100),
    (80, 32, 141),
    (21, 17, 105),
    (45, 45, 135),
    (60, 36, 70),
)
IN_PLANE_DEG = (
    (37, 2, 0),
    (70, 5, 0),
    (37.5, 27.5, 180),
    (67.5, 32.5, 180),
    (47, 45, 180),
    (80, 35, 0),
    (62.5, 42.5, 180),
    (64, 59, 180),
    (44, 12, 0),
    (58, 5, 180),
    (13, 7, 180),
    (78, 75, 180),
    (47.5, 37.5, 0),
    (26, 25, 180),
    (61, 19, 180),
    (67.5, 52.5, 180),
    (70, 10, 0),
    (77.5, 42.5, 180),
    (43, 3, 180),
    (37.5, 27.5, 0),
    (6, 4, 180),
    (77, 18, 180),
    (79, 61, 180),
    (80, 70, 0),
    (53, 26, 180),
    (65, 5, 180),
    (41, 39, 180),
    (69, 11, 180),
    (60, 60, 180),
    (31, 0, 0),
    (77.5, 27.5, 180),
    (30, 30, 180),
)
NEAR_DEG = 2.0  # of what was measured from what was planned
DESIGNS = {(8, False): EIGHT_DEG, (16, False): SIXTEEN_DEG, (32, True): IN_PLANE_DEG}


def learnt_directions(budget: int, in_plane: bool, measured: Geometry | None = None) -> Geometry | None:
    """So many, the first eight good alone; after these, measured to `NEAR_DEG` in each angle, the second eight. None
    where none were learnt."""
    if measured is None:
        angles = DESIGNS.get((budget, in_plane))
    else:
        more = SIXTEEN_DEG[len(EIGHT_DEG) :]
        angles = more if budget == len(more) and not in_plane and _is_first_block(measured) else None
    if angles is None:
        return None
    theta_i, theta_r, phi = np.array(angles).T
    return rows(Geometry.from_degrees(theta_i, 0.0, theta_r, phi))


def _is_first_block(measured: Geometry) -> bool:
    if len(measured) != len(EIGHT_DEG):
        return False
    there = np.concatenate([measured.theta_i_deg, measured.theta_r_deg, np.abs(measured.phi_deg)], axis=1)
    back = there[:, [1, 0, 2]]  # light and detector exchanged
    off = [np.minimum(*(np.abs(way - each).max(axis=1) for way in (there, back))) for each in np.array(EIGHT_DEG)]
    found = {int(np.argmin(each)) for each in off if each.min() <= NEAR_DEG}
    return len(found) == len(EIGHT_DEG)
