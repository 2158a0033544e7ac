# SPDX-FileCopyrightText: The hri contributors
# SPDX-License-Identifier: Apache-2.0
"""Make python/hri/recognition/word/filler_words.npz: words by synthetic voices (espeak-ng).

None of them is a digit or a command of the demo. Run it again only to change the words: another version of espeak-ng
gives other samples.
"""

from pathlib import Path

import numpy as np

from hri.recognition.word.fillers import RATE_HZ, compress
from hri.signal import resample
from hri.synthetic.speech import make_speaker, speak

OUTPUT = Path(__file__).parents[1] / "python" / "hri" / "recognition" / "word" / "filler_words.npz"
NUM_VOICES = 4
NUM_SPEAKERS = 48
ENGLISH = (
    "water people mother house garden window yellow purple winter morning coffee music "
    "paper school happy money river doctor fish bird chair book jump sleep"
)
HINDI = {
    "paani": "पानी", "roti": "रोटी", "doodh": "दूध", "chai": "चाय", "kela": "केला", "baazaar": "बाज़ार",
    "shikshak": "शिक्षक", "dost": "दोस्त", "bahan": "बहन", "bachcha": "बच्चा", "aurat": "औरत", "raja": "राजा",
    "sooraj": "सूरज", "aakash": "आकाश", "nadi": "नदी", "pahaad": "पहाड़", "jangal": "जंगल", "phool": "फूल",
    "ghoda": "घोड़ा", "billi": "बिल्ली", "machhli": "मछली", "peela": "पीला", "subah": "सुबह", "shaam": "शाम",
}  # fmt: skip


def main() -> None:
    """Say every word in some voices, every voice about as often as the others."""
    spoken = [(word, word, "en") for word in ENGLISH.split()] + [(name, text, "hi") for name, text in HINDI.items()]
    codes, labels = [], []
    for number, (label, text, language) in enumerate(spoken):
        for voice in range(NUM_VOICES):
            audio = speak(text, language, make_speaker((number * NUM_VOICES + voice) % NUM_SPEAKERS))
            codes.append(compress(resample(audio.samples, audio.sample_rate_hz, RATE_HZ)))
            labels.append(label)
    ends = np.cumsum([c.size for c in codes])
    np.savez_compressed(OUTPUT, codes=np.concatenate(codes), ends=ends, labels=np.array(labels))
    print(f"{len(codes)} recordings of {len(spoken)} words, {ends[-1] / RATE_HZ:.0f} s, {OUTPUT.stat().st_size} bytes")


if __name__ == "__main__":
    main()
