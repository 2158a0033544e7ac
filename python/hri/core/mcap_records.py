# SPDX-FileCopyrightText: The hri contributors
# SPDX-License-Identifier: Apache-2.0
"""Records of MCAP files that strangers may have made, by the package mcap (the extra "mcap")."""

from __future__ import annotations

import io
from collections.abc import Iterator
from dataclasses import replace
from typing import IO, Any

from hri.core.optional import import_optional

_RECORD_HEAD = 1 << 16


def mcap_records(file: IO[bytes], max_chunk_bytes: int, max_bytes: int | None = None) -> Iterator[Any]:
    """All records in the order of the file, those of chunks too; a chunk unfolds no further than it says it holds.

    One record is in memory at a time, or one chunk with one of its records.

    Parameters
    ----------
    file : binary file
        From its beginning on.
    max_chunk_bytes : int
        How much a record may hold, and a chunk once decompressed.
    max_bytes : int, optional
        How much all chunks may hold once decompressed.

    Raises
    ------
    ImportError
        Without mcap.
    Exception
        Of many kinds, for what is damaged or too large.
    """
    from mcap.records import Chunk

    mcap = import_optional("mcap.stream_reader", "mcap", "to read MCAP")
    reader = mcap.StreamReader(
        file, emit_chunks=True, validate_crcs=True, record_size_limit=max_chunk_bytes + _RECORD_HEAD
    )
    left = max_bytes
    for record in reader.records:
        if not isinstance(record, Chunk):
            yield record
            continue
        left = None if left is None else left - record.uncompressed_size
        if (left is not None and left < 0) or record.uncompressed_size > max_chunk_bytes:
            most = "" if max_bytes is None else f"{max_bytes} bytes, or "
            raise ValueError(f"holds more than {most}{max_chunk_bytes} bytes in a chunk")
        yield from _records_of(replace(record, compression="", data=_decompressed(record)))


def _records_of(chunk: Any) -> Iterator[Any]:
    """The records of a chunk one by one: a list of all small ones would take many times the chunk's size."""
    from mcap.opcode import Opcode
    from mcap.records import Channel, Message, Schema
    from mcap.stream_reader import get_chunk_data_stream

    stream, num_bytes = get_chunk_data_stream(chunk, validate_crc=True)
    while stream.count < num_bytes:
        opcode, length = stream.read1(), stream.read8()
        if opcode == Opcode.MESSAGE:
            yield Message.read(stream, length)
        elif opcode == Opcode.CHANNEL:
            yield Channel.read(stream)
        elif opcode == Opcode.SCHEMA:
            yield Schema.read(stream)
        else:
            stream.read(length)


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
