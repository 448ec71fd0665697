"""Links that leave docs/ lead to the repository that mkdocs.yml names; else they are words."""

import os
import re


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
