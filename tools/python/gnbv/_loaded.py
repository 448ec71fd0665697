"""Whether the parts of the package fit each other and this Python; if not, one line says so."""

import platform
from pathlib import Path

_HERE = f"gnbv in {Path(__file__).parent}"

try:
    from gnbv import _core
    from gnbv._version import VERSION
except ImportError as error:
    raise ImportError(
        f"{_HERE} is not built for {platform.python_implementation()} "
        f"{platform.python_version()} on this system: {error}"
    ) from None
__version__: str = VERSION
_built: str = vars(_core)["__version__"]  # of which stubs say nothing
if _built != __version__:
    raise ImportError(
        f"{_HERE}: the extension is of version {_built}, the package of {__version__}: "
        "two versions are installed in one place; remove it and install one"
    )
