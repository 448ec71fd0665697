#!/usr/bin/env bash
# Runs the shell commands of a page as a reader would paste them: every code block without a
# language or of language sh, in order, in an empty folder where build/release is that of the program under test.
#
# usage: page_commands.sh PAGE.md PROGRAM
# exit: 0 all commands succeeded, 1 one did not, or the page shows none
set -euo pipefail
page=$(realpath "$1")
program=$(realpath "$2")

folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
mkdir -p "$folder/build"
ln -s "$(dirname "$program")" "$folder/build/release"
cd "$folder"
awk '/^```/ { open = !open; is_shell = open && ($0 == "```" || $0 == "```sh"); next } is_shell' "$page" > commands.sh
grep -q . commands.sh || { echo "$page shows no command" >&2; exit 1; }
bash -euxo pipefail commands.sh
