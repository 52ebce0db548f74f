"""Files and folders: written whole, locked between processes, bounded before they are read."""

from certkit.files.whole_file import write_whole

__all__ = ["write_whole"]
