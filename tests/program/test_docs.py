"""The documents: links lead somewhere, what is generated is fresh, every decision is in the index,
man pages and completions know every command, and MkDocs builds the site where it is installed."""
import os
import re
import shutil
import subprocess
import sys

import pytest
from program import REPOSITORY

FOLDERS = ('docs', 'bench/results', '.github')
PAGES = sorted([*REPOSITORY.glob('*.md'), *(page for folder in FOLDERS
                                            for page in (REPOSITORY / folder).rglob('*.md'))])
DECISIONS = REPOSITORY / 'docs/decisions'


def prose(page):
    """The page without its code."""
    text = re.sub(r'^```.*?^```', '', page.read_text(), flags=re.M | re.S)
    return re.sub(r'`[^`\n]*`', 'code', text)


def anchors(page):
    """Of the headings, as code hosts and MkDocs name them."""
    text = re.sub(r'^```.*?^```', '', page.read_text(), flags=re.M | re.S)
    headings = re.findall(r'^#+ (.*)$', text, re.M)
    return {re.sub(r'[^\w\- ]', '', re.sub(r'\[([^]]*)\]\([^)]*\)', r'\1', heading)).strip().lower()
            .replace(' ', '-') for heading in headings}


@pytest.mark.parametrize('page', PAGES, ids=lambda page: str(page.relative_to(REPOSITORY)))
def test_links_lead_somewhere(page):
    for link in re.findall(r'\]\(([^)\s]+)\)', prose(page)):
        if re.match(r'\w+:', link):
            continue
        path, _, anchor = link.partition('#')
        target = (page.parent / path).resolve() if path else page
        assert target.exists(), f'{page}: {link}: no such file'
        assert REPOSITORY in target.parents, f'{page}: {link} leaves the repository'
        if anchor:
            assert anchor in anchors(target), f'{page}: {link}: no such heading'


def test_every_decision_is_in_the_index_with_its_title_and_status():
    index = (DECISIONS / 'README.md').read_text()
    files = sorted(DECISIONS.glob('[0-9]*.md'))
    for file in files:
        text = file.read_text()
        number, title = re.match(r'# (\d+)\. (.*)\n', text).groups()
        assert int(file.name[:4]) == int(number)
        status = re.search(r'^- Status: ([\w ]+?)(?: by |: |$)', text, re.M)[1]
        row = rf'^\| {number} \| \[{re.escape(title)}\]\({file.name}\) \| {status}'
        assert re.search(row, index, re.M), file
        assert re.search(r'^- Date: 2\d{3}-\d\d$', text, re.M) and '**Question.**' in text, file
    assert len(re.findall(r'^\| \d+ \|', index, re.M)) == len(files)


def test_every_field_that_a_planner_sees_is_documented():
    header = (REPOSITORY / 'planner/view/view_stats.hpp').read_text()
    source = (REPOSITORY / 'tools/python/gnbv/_planner.py').read_text()
    page = (REPOSITORY / 'docs/reference/python.md').read_text()
    views = re.findall(r'GNBV_VIEW_FIELD\((\w+), "', header)
    history = re.findall(r'\("(\w+)", "[fi]8"\)', source)
    assert len(views) == 23 and len(history) == 10
    for field in views + history:
        assert f'`{field}`' in page, field
    words = ' '.join(re.findall(r'"""(.*?)"""', source, re.S))
    for field in views:
        assert re.search(rf'\b{field}\b', words), f'help(gnbv) does not tell of {field}'
    for field in re.findall(r'GNBV_VIEW_FIELD\((\w+), "...", shadow\)', header):  # not of evaluate()
        assert f'`{field}`' in page.split('| field |')[0]
        assert re.search(rf'Only utilities get [^.]*\b{field}\b', source), field


def docs(gnbv, *words):
    return subprocess.run([sys.executable, REPOSITORY / 'tools/docs', *words], capture_output=True,
                          text=True, env=os.environ | {'GNBV': str(gnbv.path)})


def test_the_reference_pages_are_what_the_program_says(gnbv):
    end = docs(gnbv, '--check')
    assert end.returncode == 0, end.stderr
    keys = (REPOSITORY / 'docs/reference/keys.md').read_text()
    assert '`vehicle.autopilot.tilt_max_deg` | number, above 0 to below 90 |' in keys


def test_man_pages_and_completions_know_every_command_and_option(gnbv, run, tmp_path):
    assert docs(gnbv, '--install', tmp_path).returncode == 0
    bash = (tmp_path / 'bash-completion/completions/gnbv').read_text()
    fish = (tmp_path / 'fish/vendor_completions.d/gnbv.fish').read_text()
    zsh = (tmp_path / 'zsh/vendor-completions/_gnbv').read_text()
    def helped(*words):
        return subprocess.run([gnbv.path, *words, '--help'], capture_output=True, text=True).stdout

    def below(*words):
        rows = helped(*words).split('Subcommands:')[1].split('\n\n')[0]
        return [' '.join([*words, part]) for part in re.findall(r'^  (\w+) ', rows, re.M)]

    commands = below() + below('bench')
    assert len(commands) > 20
    for command in commands:
        text = helped(*command.split())
        name = command.replace(' ', '-')
        page = (tmp_path / f'man/man1/gnbv-{name}.1').read_text().replace('\\-', '-')
        for line in text.partition('\nExamples:\n')[2].splitlines():
            assert line.strip() in page, (command, line)
        for option in set(re.findall(r'^  (?:-\w,)?(--[\w-]+)', text, re.M)):
            assert re.search(rf'(\\fB|,){option}[,\\]', page), (command, option)
            assert re.search(rf'(?<![\w-]){option}(?![\w-])', bash) and f"'{option}[" in zsh.replace(
                "'*", "'"), (command, option)
            assert re.search(rf"_in ' {command}'\" .*-l {option[2:]} ", fish), (command, option)
    ask = f'''source {tmp_path}/bash-completion/completions/gnbv
        ask() {{ COMP_WORDS=("$@") COMP_CWORD=$(($#-1)) COMPREPLY=(); _gnbv
                 echo "${{COMPREPLY[*]}}"; }}
        ask gnbv comp; ask gnbv run --cand; ask gnbv export --format col
        ask gnbv bench ver; ask gnbv bench run --tr; ask gnbv run --tr'''
    said = subprocess.run(['bash', '-c', ask], capture_output=True, text=True).stdout
    assert said.splitlines() == ['compare', '--candidates', 'colmap', 'verify', '--track', '']
    if shutil.which('man'):
        shown = subprocess.run(['man', '--warnings', '-l', tmp_path / 'man/man1/gnbv-run.1'],
                               capture_output=True, text=True, env=os.environ | {'LC_ALL': 'C'})
        assert 'fly one mission' in shown.stdout and not shown.stderr


def test_mkdocs_builds_the_site(tmp_path):
    extras = os.environ.get('GNBV_EXTRAS_PYTHON', REPOSITORY / 'build/extras/bin/python')
    python = extras if os.path.exists(extras) else sys.executable
    if subprocess.run([python, '-c', 'import mkdocs, material, mkdocstrings']).returncode != 0:
        pytest.skip('no mkdocs-material and mkdocstrings: tools/setup --all')
    end = subprocess.run([python, '-m', 'mkdocs', 'build', '--strict', '-d', tmp_path / 'site'],
                         cwd=REPOSITORY, capture_output=True, text=True)
    assert end.returncode == 0, end.stdout + end.stderr
    page = (tmp_path / 'site/reference/python/index.html').read_text()
    assert 'id="gnbv.Belief.evaluate"' in page, 'the package is not documented'


def test_doxygen_warns_of_nothing_in_the_public_headers(tmp_path):
    if not shutil.which('doxygen'):
        pytest.skip('no doxygen: tools/setup --all')
    listed = re.findall(r'`gnbv/([\w/]+\.hpp)`', (REPOSITORY / 'docs/reference/cpp.md').read_text())
    settings = (REPOSITORY / 'docs/Doxyfile').read_text()
    assert sorted(listed) == sorted(re.findall(r'[\w/]+\.hpp', settings))
    sys.path.insert(0, str(REPOSITORY / 'docs'))
    import hooks
    hooks.write_cpp(tmp_path / 'cpp')
    page = (tmp_path / 'cpp/classgnbv_1_1Onboard.html').read_text()
    assert 'load_profile' in page and 'a file of another map' in page
