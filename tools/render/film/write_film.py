"""Writes images as a film by Pillow; `python3 -c` of the program (film.cpp) runs it with the file,
its format, width and height in pixels, and images a second. Its stdin: before each image, 8-bit
RGB, the byte 1, and 0 at the end. Its stdout: a line when it is ready for them and one when the
film is there, both empty, or one sentence of what is missing or went wrong."""

import sys

sys.path = [p for p in sys.path if p]  # nothing of the folder that the user is in

import zlib  # noqa: E402


def main(path: str, kind: str, *numbers: str) -> str:
    try:
        from PIL import Image
    except ImportError:
        return (
            "needs Pillow, Debian package python3-pil; GNBV_PYTHON names another Python than "
            f"{sys.executable}"
        )
    print(flush=True)
    width, height, images_per_s = map(int, numbers)
    packed = []  # raw, a minute of film would fill the memory
    while sys.stdin.buffer.read(1) == b"\1":
        packed.append(zlib.compress(sys.stdin.buffer.read(3 * width * height), 1))

    class Images:
        """Those after the first; Pillow may go through them more than once."""

        def __iter__(self):
            return map(image, packed[1:])

    def image(data: bytes):
        return Image.frombytes("RGB", (width, height), zlib.decompress(data))

    lossless = {"lossless": True} if kind == "WEBP" else {}
    image(packed[0]).save(
        path,
        kind,
        save_all=True,
        append_images=Images(),
        duration=1000 / images_per_s,
        loop=0,
        **lossless,
    )
    return ""


try:
    print(main(*sys.argv[1:]))
except Exception as error:
    print(f"{type(error).__name__}: {error}")
