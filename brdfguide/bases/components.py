"""A linear basis from tables of other surfaces: principal components of their ln f at the same directions.

Source: Matusik, Pfister, Brand and McMillan 2003, "A data-driven reflectance model", which has them of 100 materials.
"""

import numpy as np

EVERY = 1e-2  # ridge on the coefficients, in units of a component's own spread


def principal(tables: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Mean (samples,) and components (surfaces - 1, samples) of ln f (surfaces, samples), the largest first; each as
    long as one standard deviation over the surfaces.
    """
    mean = tables.mean(axis=0)
    about = tables - mean
    values, vectors = np.linalg.eigh(about @ about.T)
    order = np.argsort(values)[::-1][: len(tables) - 1]
    return mean, (vectors[:, order].T @ about) / np.sqrt(max(len(tables) - 1, 1))


def fit_principal(mean: np.ndarray, parts: np.ndarray, ln: np.ndarray, known: np.ndarray, count: int) -> np.ndarray:
    """ln f (samples,) from the first `count` components, by those directions that are `known`."""
    columns = parts[:count].T
    wanted = (ln - mean)[known]
    normal = columns[known].T @ columns[known] + EVERY * np.eye(count)
    return mean + columns @ np.linalg.solve(normal, columns[known].T @ wanted)
