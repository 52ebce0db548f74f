"""Unformatted Fortran records, big-endian: each has its length in bytes before and behind it."""

from __future__ import annotations

import struct

from certkit.errors import DataError


class FortranRecords:
    """The file's records one after the other, each checked by the lengths around it."""

    def __init__(self, content: bytes, source: str) -> None:
        self._content, self._source, self._at = content, source, 0

    def __bool__(self) -> bool:
        """Tell whether a record is left."""
        return self._at < len(self._content)

    def next(self) -> bytes:
        """Return the next record without its lengths."""
        at, content = self._at, self._content
        if at + 4 > len(content):
            raise self._cut()
        (length,) = struct.unpack_from(">i", content, at)
        end = at + 4 + length
        if length < 0:
            raise DataError(
                f"{self._source}: byte {at} is no record of a native OpenRadioss time history; copy "
                "it as binary, or name its format"
            )
        if end + 4 > len(content):
            if at == 0 and _is_little_endian(content):
                raise DataError(
                    f"{self._source}: its records are little-endian, those of a native history "
                    "big-endian; let the solver write its default binary format, or convert the file to CSV"
                )
            raise self._cut()
        if struct.unpack_from(">i", content, end)[0] != length:
            raise DataError(
                f"{self._source}: the record at byte {at} has two different lengths; is this a native "
                "OpenRadioss "
                "time history (…T01), copied as binary?"
            )
        self._at = end + 4
        return content[at + 4 : end]

    def integers(self) -> tuple[int, ...]:
        """Return the next record as whole numbers."""
        record = self.next()
        if len(record) % 4:
            raise DataError(
                f"{self._source}: a directory record before byte {self._at} is damaged; copy it again"
            )
        return struct.unpack(f">{len(record) // 4}i", record)

    def _cut(self) -> DataError:
        return DataError(
            f"{self._source}: the file ends inside the record at byte {self._at}; it was cut: copy it again"
        )


def _is_little_endian(content: bytes) -> bool:
    """Tell whether the first record is whole when its length is read the other way round."""
    (length,) = struct.unpack_from("<i", content)
    end = 4 + length
    whole = length > 0 and end + 4 <= len(content)
    return whole and struct.unpack_from("<i", content, end) == (length,)
