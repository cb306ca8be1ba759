"""The mirror plane of a cloud."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
from scipy.spatial import cKDTree

from .bodies import Array
from .cloud import Cloud, Frame
from .starts import principal_axes

# Points that planes are tried on, and rounds that one is moved to where it fits best.
_POINTS, _ROUNDS = 3000, 8
# A mirrored point may be so many times further from the cloud than the cloud's points are from each other.
_NEAR = 1.25
# A plane within so much of one of the world's is that one: the sine of the angle, and the distance as a share of the diagonal.
_WORLD = 0.01


def mirrored_frame(cloud: Cloud) -> Frame | None:
    """The cloud's frame moved so that x = 0 is its mirror plane; None where it has none."""
    points = cloud.part(_POINTS).points
    tree = cKDTree(points)
    near = np.quantile(tree.query(points, 2)[0][:, 1], (0.5, 0.9))
    best, least = None, _NEAR
    for start in np.concatenate([cloud.frame.rotation.T, principal_axes(points)]):
        normal, at = _settled(points, tree, start)
        away = np.quantile(tree.query(_reflected(points, normal, at))[0], (0.5, 0.9))
        if (score := float(np.max(away / near))) < least:
            best, least = (normal, at), score
    return None if best is None else _framed(cloud.frame, *best)


def _settled(points: Array, tree: cKDTree, normal: Array) -> tuple[Array, float]:
    """The plane normal . x = at near a first guess about which points pair best with the images of others."""
    at = float(np.mean(points @ normal))
    for _ in range(_ROUNDS):
        distance, number = tree.query(_reflected(points, normal, at))
        good = distance <= np.quantile(distance, 0.8)
        across = (points - points[number])[good]
        direction = np.linalg.eigh(across.T @ across)[1][:, -1]
        normal = direction if direction @ normal > 0 else -direction
        at = float(np.median((points + points[number])[good] @ normal) / 2)
    return normal, at


def _reflected(points: Array, normal: Array, at: float) -> Array:
    return np.asarray(points - 2 * np.outer(points @ normal - at, normal))


def _framed(frame: Frame, normal: Array, at: float) -> Frame:
    """The frame with its origin moved onto the plane and its first axis across it."""
    across = normal @ frame.rotation
    level = float(across @ frame.centre) + at * frame.size  # of the plane, in the world
    axis = int(np.argmax(np.abs(across)))
    square = np.eye(3)[axis]
    if np.linalg.norm(np.cross(across, square)) < _WORLD and abs(level) < _WORLD * frame.size:
        return replace(frame, centre=frame.centre * (1 - square), rotation=np.roll(np.eye(3), axis, axis=1), mirror_axis=axis)
    up = np.eye(3)[np.argmin(np.abs(across))]
    second = np.cross(up, across) / np.linalg.norm(np.cross(up, across))
    centre = frame.centre + (level - float(across @ frame.centre)) * across
    return replace(frame, centre=centre, rotation=np.stack([across, second, np.cross(across, second)]))
