# SPDX-FileCopyrightText: The hri contributors
# SPDX-License-Identifier: Apache-2.0
"""Make the two files of filler words in python/hri/recognition/word: words by synthetic voices (espeak-ng).

None of them is a digit or a command of the demo. Run it again only to change the words: another version of espeak-ng
gives other samples. Names of files to make may be given; by default both are made.
"""

import sys
from pathlib import Path

import numpy as np

from hri.recognition.word.fillers import EMBEDDING_RATE_HZ, RATE_HZ, compress
from hri.signal import resample
from hri.synthetic.speech import make_speaker, speak

FOLDER = Path(__file__).parents[1] / "python" / "hri" / "recognition" / "word"
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

EMBEDDING_ENGLISH = (
    "apple banana orange table pencil kitchen bottle finger shoulder elephant tiger monkey rabbit sugar "
    "butter cheese bread dinner breakfast summer autumn spring weather thunder rainbow mountain valley "
    "forest island ocean village city street bridge station airport hospital market museum library "
    "teacher student farmer soldier painter brother sister father uncle daughter family friend neighbour "
    "holiday birthday wedding present candle ribbon basket blanket pillow carpet curtain mirror hammer "
    "needle scissors engine wheel bicycle train ship plane ticket pocket jacket trousers shirt shoes hat "
    "glove evening midnight monday tuesday wednesday saturday january august october english history "
    "science number letter question answer story picture camera radio engineer computer keyboard screen "
    "tea milk rice potato tomato onion pepper salt lemon grass leaf stone sand cloud star moon sun fire "
    "smoke hot cold small large long short heavy light angry hungry thirsty tired beautiful"
)
EMBEDDING_HINDI = (
    "सेब आम संतरा अंगूर आलू प्याज टमाटर गाजर चावल दाल सब्ज़ी नमक चीनी मिर्च हल्दी मक्खन दही मिठाई अंडा "
    "मुर्गी गाय भैंस बकरी कुत्ता शेर हाथी बंदर चूहा खरगोश हिरन साँप मोर तोता कौआ चिड़िया पेड़ पत्ता घास "
    "खेत किसान गाँव शहर सड़क गली पुल दुकान मंदिर मस्जिद विद्यालय कक्षा पुस्तकालय कलम काग़ज़ स्याही मेज़ "
    "कुर्सी खिड़की दरवाज़ा दीवार छत आँगन रसोई बर्तन थाली चम्मच गिलास कपड़ा जूता टोपी साड़ी धागा सुई कैंची "
    "साबुन तौलिया बिस्तर तकिया चादर माता पिता भाई बेटा बेटी दादा नाना चाचा मामा पति पत्नी राजकुमार रानी "
    "सैनिक डॉक्टर अध्यापक छात्र गाड़ी बस रेलगाड़ी नाव हवाई साइकिल यात्रा बारिश बादल बिजली हवा तूफ़ान "
    "गर्मी सर्दी वसंत तारा चाँद धरती समुद्र रेत पत्थर आग धुआँ रात दोपहर सप्ताह महीना साल सोमवार मंगलवार "
    "शनिवार सवाल जवाब गीत नाच चित्र रंग लाल हरा नीला काला सफ़ेद मीठा खट्टा कड़वा गरम ठंडा छोटा बड़ा लंबा"
)

Spoken = list[tuple[str, str, str]]
"""Labels, texts and languages."""


def make(output: Path, spoken: Spoken, num_voices: int, rate_hz: int) -> None:
    """Say every word in some voices, every voice about as often as the others."""
    codes, labels = [], []
    for number, (label, text, language) in enumerate(spoken):
        for voice in range(num_voices):
            audio = speak(text, language, make_speaker((number * num_voices + voice) % NUM_SPEAKERS))
            codes.append(compress(resample(audio.samples, audio.sample_rate_hz, rate_hz)))
            labels.append(label)
    ends = np.cumsum([c.size for c in codes])
    np.savez_compressed(output, codes=np.concatenate(codes), ends=ends, labels=np.array(labels))
    print(f"{len(codes)} recordings of {len(spoken)} words, {ends[-1] / rate_hz:.0f} s, {output.stat().st_size} bytes")


def main(names: list[str]) -> None:
    """Make the files of these names."""
    words = [(word, word, "en") for word in ENGLISH.split()] + [(name, text, "hi") for name, text in HINDI.items()]
    more = [(w, w, "en") for w in EMBEDDING_ENGLISH.split()] + [(w, w, "hi") for w in EMBEDDING_HINDI.split()]
    files = {
        "filler_words.npz": (words, NUM_VOICES, RATE_HZ),
        "embedding_filler_words.npz": (more, 1, EMBEDDING_RATE_HZ),
    }
    for name in names or files:
        make(FOLDER / name, *files[name])


if __name__ == "__main__":
    main(sys.argv[1:])
