# SPDX-FileCopyrightText: The hri contributors
# SPDX-License-Identifier: Apache-2.0
"""The study of hand signs of persons left out: who is in a picture, what the joints crop, and drawn signs."""

from __future__ import annotations

import os
from collections import Counter
from pathlib import Path
from typing import Any

import cv2
import numpy as np
import pytest
from numpy.typing import NDArray

from hri import studies
from hri.core.errors import InvalidArgument
from hri.datasets import Fold
from hri.recognition import GestureRecognizer
from hri.studies import people_signs
from hri.synthetic.signer import draw_still, make_signer
from hri.vision.hands import find_silhouettes

Frame = NDArray[np.uint8]
SIGNS = ("1", "2", "5")
CLOTHES = ("blue coat", "red shirt", "white shirt")
TAKES = 4
UNSEEN = "blue coat"
"""In whose first picture no joints are found."""


def outline(picture: Frame) -> NDArray[np.float32] | None:
    """21 points along the hand in place of joints; None of a picture that is marked in its corner."""
    if picture[:8, :8].max() < 20:
        return None
    mask = np.asarray(find_silhouettes([picture], faces="never")[0].mask)
    contours, _ = cv2.findContours(mask, cv2.RETR_EXTERNAL, cv2.CHAIN_APPROX_NONE)
    points = max(contours, key=len)[:, 0].astype(np.float32) * picture.shape[1] / mask.shape[1]
    return points[np.linspace(0, len(points) - 1, 21).astype(int)]


class Tracker:
    def __init__(self, **_: object) -> None: ...
    def find_all(self, picture: Frame) -> list[NDArray[np.float32]]:
        points = outline(picture)
        return [] if points is None else [points]

    def close(self) -> None: ...


@pytest.fixture(scope="module")
def data_dir(tmp_path_factory: pytest.TempPathFactory) -> Path:
    folder = tmp_path_factory.mktemp("data")
    people = folder / people_signs.DATA
    lines = []
    for person, clothes in enumerate(CLOTHES):
        lines += ["[[person]]", f'clothes = "{clothes}"', "[person.pictures]"]
        takes = [TAKES * person + take + 1 for take in range(TAKES)]
        for sign in (*SIGNS, "no_class"):
            place = people / "hand" / sign
            place.mkdir(parents=True, exist_ok=True)
            for take in takes:
                picture = draw_still(make_signer(person), sign if sign in SIGNS else "3", take)
                if (clothes, sign, take) == (UNSEEN, "1", takes[0]):
                    picture[:8, :8] = 0
                cv2.imwrite(str(place / f"{take:02d}.jpg"), picture)
            if sign in SIGNS:
                lines.append(f"{sign} = {takes}")
    again = people / "hand" / "9"
    again.mkdir()
    for path in (people / "hand" / "5").iterdir():
        (again / path.name).write_bytes(path.read_bytes())
    (people / people_signs.CLOTHES).write_text("\n".join(lines))
    return folder


@pytest.fixture
def seen_alone(monkeypatch: pytest.MonkeyPatch) -> None:
    """Drawn hands have no face, and joints that no tracker sees."""
    monkeypatch.setattr(people_signs, "face_finder", lambda required: "never")
    monkeypatch.setattr(people_signs, "LandmarkTracker", Tracker)
    monkeypatch.setattr(people_signs, "find_spec", lambda _: object())


def run(data_dir: Path, **only: Any) -> dict[str, Any]:
    study = studies.get_study("people-signs")
    return studies.run_study(study, data_dir, lambda *_: None, only)


@pytest.mark.usefixtures("seen_alone")
def test_every_person_is_left_out(data_dir: Path) -> None:
    result = run(data_dir, features=("joined", "joints", "chosen"))
    assert result["signs"] == list(SIGNS) and result["repeated"] == {"9": "5"} and result["chance"] == 1 / 3
    found = {(row["hands"], row["features"], row["left out"]): row for row in result["rows"]}
    places = [(way, "joined") for way in people_signs.HANDS if way not in ("any crop", "landmarks")]
    places += [("landmarks", "joints")] + [(way, "chosen") for way in ("silhouettes", "any crop", "landmarks")]
    assert set(found) == {(*place, who) for place in places for who in (*CLOTHES, people_signs.ALL)}
    for place in places:
        whole = found[(*place, people_signs.ALL)]
        each = {clothes: found[(*place, clothes)] for clothes in CLOTHES}
        assert whole["per_fold"] == {clothes: row["accuracy_mean"] for clothes, row in each.items()}
        assert sum(row["counts"]["right"] for row in each.values()) == whole["counts"]["right"]
        assert whole["counts"]["pictures"] == len(SIGNS) * len(CLOTHES) * TAKES, "none twice, none without a sign"
    for way in ("silhouettes", "crop by chroma", "crop by face"):
        assert found[way, "joined", people_signs.ALL]["accuracy_mean"] > 0.85
    assert found["silhouettes", "joined", UNSEEN]["found_mean"] == 1
    pictures = len(SIGNS) * TAKES
    lost = found["landmarks", "joints", UNSEEN]
    assert lost["found_mean"] == 1 - 1 / pictures and lost["accuracy_mean"] <= lost["found_mean"]
    chosen = found["any crop", "chosen", people_signs.ALL]["chosen"]
    assert set(chosen) == set(CLOTHES) and all(choice.startswith("crop by ") for choice in chosen.values())
    assert found["silhouettes", "chosen", people_signs.ALL]["chosen"][UNSEEN].startswith("silhouettes, ")


@pytest.mark.usefixtures("seen_alone")
def test_without_mediapipe_silhouettes_are_measured(data_dir: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(people_signs, "find_spec", lambda _: None)
    monkeypatch.delattr(people_signs, "LandmarkTracker")
    result = run(data_dir, features=("joined", "joints"))
    assert {row["hands"] for row in result["rows"]} == {"silhouettes"} and "mediapipe" in result["not_measured"]


def test_what_is_chosen_is_chosen_by_the_pictures_trained_on() -> None:
    signs = [sign for sign in SIGNS for _ in range(12)]
    trained = [i for i in range(len(signs)) if i % 3]
    rng = np.random.default_rng(0)
    clear = np.eye(3, 6, dtype=np.float32)[[SIGNS.index(sign) for sign in signs]]
    noise = rng.standard_normal((len(signs), 6)).astype(np.float32)
    of_training = np.isin(np.arange(len(signs)), trained)[:, None]
    good, bad = np.where(of_training, clear, noise), np.where(of_training, noise, clear)
    candidates = {("b", "joined"): list(bad), ("a", "joined"): list(good)}
    assert people_signs.choose(candidates, signs, trained) == ("a", "joined")
    fold = Fold("", trained, [i for i in range(len(signs)) if i not in trained])
    assert np.mean(people_signs.right(list(clear), signs, fold, "joined")) == 1
    without = [None if i in fold.test else row for i, row in enumerate(clear)]
    assert not any(people_signs.right(without, signs, fold, "joined"))


def test_vectors_are_those_of_the_recogniser() -> None:
    picture = draw_still(make_signer(1), "5")
    (seen,) = find_silhouettes([picture], faces="never")
    vector = people_signs._vector((np.asarray(seen.grey), np.asarray(seen.mask)), "joined")
    (row,) = GestureRecognizer().features([picture])
    assert vector is not None and np.array_equal(vector[:-3], row[:-3]), "the last three say where the hand is"
    empty = np.zeros_like(np.asarray(seen.mask))
    assert people_signs._vector((np.asarray(seen.grey), empty), "joined") is None


def test_joints_crop_the_picture_as_far_as_it_goes() -> None:
    picture = np.arange(100 * 120 * 3, dtype=np.uint32).astype(np.uint8).reshape(100, 120, 3)
    joints = np.array([(40 + 20 * (i % 3) / 2, 30 + 20 * (i // 3) / 6) for i in range(21)], np.float32)
    cropped, within = people_signs.crop(picture, joints)
    assert cropped.shape[:2] == (32, 32) and np.array_equal(cropped, picture[24:56, 34:66])
    assert np.allclose(within, joints - (34, 24))
    hull = people_signs.hull_of(cropped.shape, within)
    assert hull[16, 16] == 255 and hull[0, 0] == 0 and 400 < (hull > 0).sum() < 700
    for shift in ((-50, 0), (75, 60), (0, 200), (300, -300)):  # beyond the edges, in part or whole
        moved = (joints + np.float32(shift)).astype(np.float32)
        cropped, within = people_signs.crop(picture, moved)
        assert cropped.size and within.shape == (21, 2)
        for hand in people_signs.CROPS.values():
            grey, mask = hand(cropped, within, np.full(cropped.shape[:2], 255, np.uint8))
            assert grey.shape == mask.shape


def test_the_colour_of_the_palm_is_that_of_the_hand() -> None:
    picture = np.full((120, 120, 3), (165, 160, 150), np.uint8)
    hand = np.zeros((120, 120), np.uint8)
    cv2.circle(hand, (60, 75), 22, 255, -1)
    cv2.line(hand, (60, 75), (60, 25), 255, 9)
    picture[hand > 0] = (110, 135, 195)
    joints = np.array([(60, 28 + i) for i in range(21)], np.float32)
    joints[[0, 1, 5, 9, 13, 17]] = [(60, 95), (42, 75), (48, 58), (60, 55), (72, 58), (78, 75)]
    _, mask = people_signs.CROPS["crop by palm"](picture, joints, np.zeros_like(hand))
    assert ((mask > 0) & (hand > 0)).sum() > 0.85 * ((mask > 0) | (hand > 0)).sum()
    _, hull = people_signs.CROPS["crop by hull"](picture, joints, np.zeros_like(hand))
    assert hull[50, 54] and hand[50, 54] == mask[50, 54] == 0, "beside the finger"


def test_a_picture_without_clothes_is_named(tmp_path: Path) -> None:
    with pytest.raises(InvalidArgument, match=r"people_clothes\.toml does not say who is in closer/25; write people/"):
        people_signs.read_clothes(["closer/01", "closer/25"])
    assert people_signs.read_clothes(["left/02", "land/01", "palm/04"][::2]) == ["black jumper", "grey printed shirt"]
    for text in ("[[person]]\npictures = 3\nclothes = ''", "[[person]]\n[person.pictures]\na = [1]", "person", "a = 1"):
        (tmp_path / "clothes.toml").write_text(text)
        with pytest.raises(InvalidArgument, match=r"clothes\.toml: no table of clothes"):
            people_signs.read_clothes(["a/01"], tmp_path / "clothes.toml")


@pytest.mark.data
def test_every_photo_has_clothes() -> None:
    data_dir = Path(os.environ["HRI_DATA"])
    if not (data_dir / people_signs.DATA).is_dir():
        pytest.skip("no photos of people")
    photos = people_signs.read_photos(data_dir)
    assert Counter(photos.clothes) == {"black hoodie": 160, "grey printed shirt": 140, "black jumper": 12}
    assert len(set(photos.signs)) == 13 and photos.repeated == {"land": "further"}
