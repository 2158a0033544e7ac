# SPDX-FileCopyrightText: The hri contributors
# SPDX-License-Identifier: Apache-2.0
"""Records of MCAP files that strangers may have made, by the package mcap (the extra "mcap")."""

from __future__ import annotations

import io
from collections.abc import Iterator
from dataclasses import replace
from typing import Any

from hri.core.optional import import_optional


def mcap_records(data: bytes, max_bytes: int, max_chunk_bytes: int) -> Iterator[Any]:
    """All records in the order of the file, those of chunks too; a chunk unfolds no further than it says it holds.

    Parameters
    ----------
    data : bytes
        The whole file.
    max_bytes, max_chunk_bytes : int
        How much all chunks and each of them may hold once decompressed.

    Raises
    ------
    ImportError
        Without mcap.
    Exception
        Of many kinds, for what is damaged or too large.
    """
    from mcap.records import Chunk

    mcap = import_optional("mcap.stream_reader", "mcap", "to read MCAP")
    reader = mcap.StreamReader(io.BytesIO(data), emit_chunks=True, validate_crcs=True, record_size_limit=len(data))
    left = max_bytes
    for record in reader.records:
        if not isinstance(record, Chunk):
            yield record
            continue
        left -= record.uncompressed_size
        if left < 0 or record.uncompressed_size > max_chunk_bytes:
            raise ValueError(f"holds more than {max_bytes} bytes, or {max_chunk_bytes} in a chunk")
        plain = replace(record, compression="", data=_decompressed(record))
        yield from mcap.breakup_chunk(plain, validate_crc=True)


def _decompressed(chunk: Any) -> bytes:
    size = chunk.uncompressed_size
    if chunk.compression == "lz4":
        lz4 = import_optional("lz4.frame", "mcap", "to read MCAP")
        data: bytes = lz4.LZ4FrameDecompressor().decompress(chunk.data, max_length=size + 1)
    elif chunk.compression == "zstd":
        zstd = import_optional("zstandard", "mcap", "to read MCAP")
        data = zstd.ZstdDecompressor().stream_reader(io.BytesIO(chunk.data)).read(size + 1)
    elif chunk.compression == "":
        data = chunk.data
    else:
        raise ValueError(f"compression {chunk.compression!r} is none of lz4, zstd")
    if len(data) != size:
        raise ValueError(f"a chunk holds {len(data)} bytes or more, not {size}")
    return data
