"""Links that leave docs/ lead to the repository that mkdocs.yml names; else they are words. Where
Doxygen is, the site has the C++ headers as pages, too, in cpp/."""

import os
import pathlib
import re
import shutil
import subprocess


def on_page_markdown(markdown, page, config, **_):
    folder = os.path.dirname(page.file.src_path)

    def outside(link):
        path, _, anchor = link[2].partition('#')
        whole = os.path.normpath(os.path.join('docs', folder, path))
        if ':' in path or not path or whole.startswith('docs/'):
            return link[0]
        if not config.repo_url:
            return link[1]
        there = f'{config.repo_url.rstrip("/")}/blob/main/{whole}'
        return f'[{link[1]}]({there}{"#" * bool(anchor)}{anchor})'

    return re.sub(r'\[([^]\n]*)\]\(([^)\s]+)\)', outside, markdown)


def write_cpp(folder):
    """The C++ reference; CalledProcessError when Doxygen warns of anything."""
    root = pathlib.Path(__file__).resolve().parents[1]
    settings = (root / 'docs/Doxyfile').read_text() + f'OUTPUT_DIRECTORY = "{folder}"\n'
    pathlib.Path(folder).mkdir(parents=True, exist_ok=True)
    subprocess.run(['doxygen', '-'], cwd=root, input=settings, text=True, check=True)


def on_post_build(config, **_):
    if shutil.which('doxygen'):
        write_cpp(pathlib.Path(config.site_dir).resolve() / 'cpp')
