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
if _core.__version__ != VERSION:
    raise ImportError(
        f"{_HERE}: the extension is of version {_core.__version__}, the package of {VERSION}: "
        "two versions are installed in one place; remove it and install one"
    )
__version__: str = VERSION
