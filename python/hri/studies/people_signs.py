# SPDX-FileCopyrightText: The hri contributors
# SPDX-License-Identifier: Apache-2.0
"""Still signs of persons in a furnished room, each person left out in turn: by silhouettes, by joints, and by pictures
that the joints crop.

The pictures do not name persons: a table beside the study names their clothes. What is chosen for a person is chosen
by the pictures of the others, see `choose`.
"""

from __future__ import annotations

import hashlib
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from functools import partial
from importlib.util import find_spec
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from hri.core.errors import InvalidArgument
from hri.core.files import parse_toml, read_bytes, read_text
from hri.core.optional import import_opencv
from hri.datasets import Fold
from hri.datasets.folds import split_by_value, split_stratified
from hri.features.hand import hand_features
from hri.media import read_image
from hri.recognition import GestureRecognizer
from hri.studies.hands_in_rooms import DATA, NO_SIGN, measured_hands
from hri.studies.registry import GESTURE_SOURCES, Layout, Progress, Study
from hri.studies.sign_features import FEATURES
from hri.vision.faces import face_finder
from hri.vision.hands import find_silhouettes
from hri.vision.landmarks import Landmarks, LandmarkTracker, landmark_features

Frame = NDArray[np.uint8]
Vector = NDArray[np.float32]
Vectors = list[Vector | None]
"""Of every picture; None where no hand is found."""
Hand = tuple[Frame, Frame]
"""A grey picture and the mask of the hand in it."""

FOLDER = "hand"
CLOTHES = "clothes.toml"
"""In the folder of the pictures, takes the place of the table that comes with the study."""
SHAPES = ("joined", "fourier (phase)", "chain code (8 parts)", "orientation 8x8x9", "mfcc")
"""Of `sign_features`; the first is what `GestureRecognizer` uses."""
JOINTS = {"joints": "automatic", "joints, svm": "svm", "joints, 5-nn": "knn"}
"""By name, the model of `GestureRecognizer`; shapes get "automatic", its default."""
CHOSEN = "chosen"
ALL = "all pictures"
MARGIN = 0.3
"""Of the square that is cropped, at each side, in sides of the smallest square with all joints."""
NUM_PARTS = 4
TRACK_COLUMNS = 3
"""Where the hand is, the last columns of what `GestureRecognizer` takes: still signs are recognised without them."""

_FLESH = 0.12
"""Joints lie within the hand: by how much of its size the hull grows; what only bounds a mask grows twice as much."""
_PALM = [0, 1, 5, 9, 13, 17]
_SKIN_DISTANCE = 3.0
_LEAST_VARIANCE = 4.0
"""Of Cr and Cb, in levels squared: those of a palm in even light may all be the same."""


@dataclass(frozen=True)
class SignPhotos:
    """Pictures of signs; of pictures that are the same file, the first."""

    paths: list[Path]
    signs: list[str]
    clothes: list[str]
    repeated: dict[str, str]
    """Signs whose pictures are those of another one, and that one."""


def read_clothes(pictures: Sequence[str], table: Path | None = None) -> list[str]:
    """What the person in every picture wears, each picture named "sign/take".

    Parameters
    ----------
    pictures : sequence of str
    table : Path, optional
        A file like people_clothes.toml, for other pictures than those it was written for.

    Raises
    ------
    InvalidArgument
        For a picture without clothes (names it and the file), or a file that is no such table.
    """
    source = Path(__file__).with_name("people_clothes.toml") if table is None else table
    try:
        known = {
            f"{sign}/{int(take):02d}": str(entry["clothes"])
            for entry in parse_toml(read_text(source), source.name)["person"]
            for sign, takes in entry["pictures"].items()
            for take in takes
        }
    except (OSError, ValueError, KeyError, TypeError, AttributeError) as error:
        raise InvalidArgument(f"{source.name}: no table of clothes: {error}") from error
    if unknown := [picture for picture in pictures if picture not in known]:
        raise InvalidArgument(f"{source.name} does not say who is in {', '.join(unknown)}; write {DATA}/{CLOTHES}")
    return [known[picture] for picture in pictures]


def read_photos(data_dir: Path) -> SignPhotos:
    """The pictures of `people/hand` that show a sign."""
    first: dict[str, Path] = {}
    repeated: dict[str, str] = {}
    for path in sorted((data_dir / DATA / FOLDER).glob("*/*.jpg")):
        if path.parent.name == NO_SIGN:
            continue
        same = first.setdefault(hashlib.sha256(read_bytes(path)).hexdigest(), path)
        if same.parent != path.parent:
            repeated[path.parent.name] = same.parent.name
    paths = list(first.values())
    own = data_dir / DATA / CLOTHES
    names = [f"{path.parent.name}/{path.stem}" for path in paths]
    clothes = read_clothes(names, own if own.exists() else None)
    return SignPhotos(paths, [path.parent.name for path in paths], clothes, repeated)


def crop(picture: Frame, joints: Landmarks) -> tuple[Frame, Landmarks]:
    """The square around the joints, as far as the picture goes, and the joints in it."""
    low, high = joints.min(axis=0), joints.max(axis=0)
    half = (0.5 + MARGIN) * float((high - low).max())
    size = np.array([picture.shape[1], picture.shape[0]])
    left, top = np.clip(np.floor((low + high) / 2 - half), 0, size - 1).astype(int)
    right, bottom = np.clip(np.ceil((low + high) / 2 + half), 1, size).astype(int)
    cropped = np.ascontiguousarray(picture[top : max(bottom, top + 1), left : max(right, left + 1)])
    return cropped, joints - np.array([left, top], np.float32)


def hull_of(shape: tuple[int, ...], joints: Landmarks, grown: float = _FLESH) -> Frame:
    """255 in the hull of the joints, grown by so much of its size."""
    cv2 = import_opencv("to draw hulls")
    hull = np.zeros(shape[:2], np.uint8)
    cv2.fillConvexPoly(hull, cv2.convexHull(joints.astype(np.int32)), 255)
    side = max(3, int(grown * np.sqrt((hull > 0).sum())) | 1)
    return np.asarray(cv2.dilate(hull, np.ones((side, side), np.uint8)), np.uint8)


def _grey(picture: Frame) -> Frame:
    cv2 = import_opencv("to crop pictures")
    return np.asarray(cv2.cvtColor(picture, cv2.COLOR_BGR2GRAY), np.uint8)


def _by_hull(picture: Frame, joints: Landmarks, mask: Frame) -> Hand:
    return _grey(picture), hull_of(picture.shape, joints)


def _by_chroma(picture: Frame, joints: Landmarks, mask: Frame) -> Hand:
    """As hands alone are found in pictures that show nothing else."""
    (found,) = find_silhouettes([picture], faces="never")
    return np.asarray(found.grey), np.asarray(found.mask)


def _by_face(picture: Frame, joints: Landmarks, mask: Frame) -> Hand:
    """What `find_silhouettes` found in the whole picture."""
    return _grey(picture), np.minimum(mask, hull_of(picture.shape, joints, 2 * _FLESH))


def _by_palm(picture: Frame, joints: Landmarks, mask: Frame) -> Hand:
    """What has the colour between the joints of the palm."""
    cv2 = import_opencv("to find skin")
    chroma = cv2.cvtColor(picture, cv2.COLOR_BGR2YCrCb)[..., 1:].astype(np.float64)
    palm = np.zeros(picture.shape[:2], np.uint8)
    cv2.fillConvexPoly(palm, cv2.convexHull(joints[_PALM].astype(np.int32)), 255)
    skin = chroma[palm > 0]
    if len(skin) < 2:
        return _grey(picture), np.zeros_like(palm)
    spread = np.cov(skin.T) + _LEAST_VARIANCE * np.eye(2)
    off = chroma - np.median(skin, axis=0)
    distances = np.einsum("...i,ij,...j", off, np.linalg.inv(spread), off)
    near = hull_of(picture.shape, joints, 2 * _FLESH)
    return _grey(picture), np.where(distances < _SKIN_DISTANCE**2, near, np.uint8(0))


CROPS: dict[str, Callable[[Frame, Landmarks, Frame], Hand]] = {
    "crop by hull": _by_hull,
    "crop by chroma": _by_chroma,
    "crop by face": _by_face,
    "crop by palm": _by_palm,
}
"""Masks in the picture that the joints crop."""
ANY_CROP = "any crop"
HANDS = ("silhouettes", *CROPS, ANY_CROP, "landmarks")
_GROUPS = {"silhouettes": ("silhouettes",), ANY_CROP: tuple(CROPS), "landmarks": ("landmarks",)}
"""Among what is chosen."""


def _find(path: Path, hands: Sequence[str], faces: Any, tracker: LandmarkTracker | None) -> dict[str, Hand | Landmarks]:
    """The hand in a picture, each way in which one is found."""
    picture = read_image(path)
    (seen,) = find_silhouettes([picture], faces=faces)
    grey, mask = np.asarray(seen.grey), np.asarray(seen.mask)
    found: dict[str, Hand | Landmarks] = {}
    if float(seen.quality) >= GestureRecognizer().options.min_quality:
        found["silhouettes"] = (grey, mask)
    joints = [] if tracker is None else measured_hands(tracker.find_all(picture), FOLDER)
    if joints:
        cv2 = import_opencv("to crop pictures")
        height, width = picture.shape[:2]
        whole = cv2.resize(mask, (width, height), interpolation=cv2.INTER_NEAREST)
        cropped, within = crop(picture, joints[0])
        cropped_mask, _ = crop(whole, joints[0])
        found |= {name: CROPS[name](cropped, within, cropped_mask) for name in hands if name in CROPS}
        found["landmarks"] = landmark_features(joints, (width, height))[0]
    return found


def _vectors(
    photos: SignPhotos, hands: Sequence[str], features: Sequence[str], faces: Any, progress: Progress
) -> dict[tuple[str, str], Vectors]:
    """By how the hand is found and the features."""
    every = {(way, name): Vectors() for way in hands for name in (JOINTS if way == "landmarks" else SHAPES)}
    every = {place: vectors for place, vectors in every.items() if place[1] in features}
    tracker = None if list(hands) == ["silhouettes"] else LandmarkTracker(each_alone=True, max_hands=2)
    try:
        for done, path in enumerate(photos.paths):
            found = _find(path, hands, faces, tracker)
            for (way, name), vectors in every.items():
                vectors.append(_vector(found.get(way), name))
            progress("finding hands", done + 1, len(photos.paths))
    finally:
        if tracker is not None:
            tracker.close()
    return every


def _vector(found: Hand | Landmarks | None, name: str) -> Vector | None:
    if found is None or not isinstance(found, tuple):
        return found
    kind, options = FEATURES[name]
    rows = hand_features([found[0]], [found[1]], kind, **options)  # type: ignore[arg-type]
    return np.concatenate([rows[0], np.zeros(TRACK_COLUMNS, np.float32)]) if len(rows) else None


def right(vectors: Vectors, signs: Sequence[str], fold: Fold, features: str) -> list[bool]:
    """Whether the best label of every picture tested is right, rejected or not; where no hand is found, it is not."""
    known = [i for i in fold.train if vectors[i] is not None]
    recognizer = GestureRecognizer(model=JOINTS.get(features, "automatic"))  # type: ignore[arg-type]
    recognizer.fit_features([vectors[i][None] for i in known], [signs[i] for i in known])  # type: ignore[index]
    found = []
    for i in fold.test:
        vector = vectors[i]
        nbest = [] if vector is None else recognizer.recognise_features(vector[None]).nbest
        found.append(bool(nbest) and nbest[0].label == signs[i])
    return found


def choose(
    candidates: dict[tuple[str, str], Vectors], signs: Sequence[str], pictures: Sequence[int]
) -> tuple[str, str]:
    """What gets most of these pictures right when parts of them are left out; of equals, the first.

    Parts are stratified by sign: of one of the persons there are two signs, which choose nothing by themselves. Each
    person is then in all parts, so that this favours what learns persons by heart.
    """
    own = [signs[i] for i in pictures]
    num_parts = min(NUM_PARTS, *(own.count(sign) for sign in set(own)))
    parts = [
        Fold(part.name, [pictures[i] for i in part.train], [pictures[i] for i in part.test])
        for part in split_stratified(own, num_parts, 0)
    ]
    score = {
        place: sum(sum(right(vectors, signs, part, place[1])) for part in parts)
        for place, vectors in candidates.items()
    }
    return max(score, key=score.__getitem__)


Score = Callable[[Fold], tuple[list[bool], list[bool], str]]
"""Of the pictures tested: which are right, in which a hand is found, and what was chosen."""


def _fixed(vectors: Vectors, photos: SignPhotos, features: str, fold: Fold) -> tuple[list[bool], list[bool], str]:
    return right(vectors, photos.signs, fold, features), [vectors[i] is not None for i in fold.test], ""


def _nested(
    candidates: dict[tuple[str, str], Vectors], photos: SignPhotos, fold: Fold
) -> tuple[list[bool], list[bool], str]:
    place = choose(candidates, photos.signs, fold.train)
    return *_fixed(candidates[place], photos, place[1], fold)[:2], ", ".join(place)


def _rows(place: dict[str, str], folds: Sequence[Fold], score: Score, say: Callable[[], None]) -> list[dict[str, Any]]:
    """A row for each person left out, and one for all."""
    rows, found, chosen = [], {}, {}
    for fold in folds:
        hits, seen, choice = score(fold)
        found[fold.name] = (hits, seen)
        if choice:
            chosen[fold.name] = choice
        rows.append(place | {"left out": fold.name} | _shares(hits, seen))
        say()
    every = [[value for part in found.values() for value in part[which]] for which in (0, 1)]
    per_fold = {name: float(np.mean(hits)) for name, (hits, _) in found.items()}
    whole = place | {"left out": ALL} | _shares(*every) | {"per_fold": per_fold}
    return [*rows, whole | ({"chosen": chosen} if chosen else {})]


def _shares(hits: Sequence[bool], seen: Sequence[bool]) -> dict[str, Any]:
    counts = {"pictures": len(hits), "right": sum(hits)}
    return {"counts": counts, "accuracy_mean": float(np.mean(hits)), "found_mean": float(np.mean(seen))}


def _run(
    data_dir: Path,
    progress: Progress,
    *,
    hands: Sequence[str] = HANDS,
    features: Sequence[str] = (*SHAPES, *JOINTS, CHOSEN),
) -> dict[str, Any]:
    photos = read_photos(data_dir)
    note = {}
    if find_spec("mediapipe") is None and "silhouettes" in hands and len(hands) > 1:
        note = {"not_measured": "landmarks and crops by them: they need the extra mediapipe"}
        hands = ["silhouettes"]
    faces = face_finder(required=True)
    wanted = SHAPES + tuple(JOINTS) if CHOSEN in features else features
    ways = [way for way in HANDS if way in hands or (ANY_CROP in hands and way in CROPS)]
    vectors = _vectors(photos, [way for way in ways if way != ANY_CROP], wanted, faces, progress)
    scores: dict[tuple[str, str], Score] = {
        place: partial(_fixed, of_place, photos, place[1])
        for place, of_place in vectors.items()
        if place[0] in hands and place[1] in features
    }
    for group in (name for name in _GROUPS if name in hands and CHOSEN in features):
        candidates = {place: of_place for place, of_place in vectors.items() if place[0] in _GROUPS[group]}
        scores[group, CHOSEN] = partial(_nested, candidates, photos)
    folds = split_by_value("clothes", photos.clothes)
    rows: list[dict[str, Any]] = []
    for way, name in scores:
        done = len(rows) // (len(folds) + 1)
        place = {"hands": way, "features": name}
        rows += _rows(place, folds, scores[way, name], partial(progress, "training", done, len(scores)))
    return {
        "signs": sorted(set(photos.signs)),
        "repeated": photos.repeated,
        "chance": 1 / len(set(photos.signs)),
        **note,
        "rows": rows,
        "passed": None,
    }


STUDIES = (
    Study(
        "people-signs",
        "hand signs of persons in a furnished room, each person left out in turn: by silhouettes, by joints, and by "
        "pictures that the joints crop; what is chosen is chosen by the other persons",
        (DATA,),
        "none: how hand signs of a person never seen are recognised in a room",
        _run,
        layout=Layout(columns="left out"),
        axes={"hands": HANDS, "features": (*SHAPES, *JOINTS, CHOSEN)},
        sources=GESTURE_SOURCES,
        quick={"hands": ("silhouettes",), "features": ("joined",)},
    ),
)
