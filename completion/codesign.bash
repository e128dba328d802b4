# shellcheck shell=bash
# Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
# Completion of `codesign` in bash; `. devel/setup.bash` loads it. Commands and options are those of the program's own help.

# The values of an option: names of files, a few words, or nothing.
_codesign_value() {
  case $1 in
    --overlay) mapfile -t COMPREPLY < <(compgen -f -X '!*.@(urdf|xml)' -- "$2"; compgen -d -- "$2") ;;
    --result) mapfile -t COMPREPLY < <(compgen -f -X '!*.json' -- "$2"; compgen -d -- "$2") ;;
    --csv | -o) mapfile -t COMPREPLY < <(compgen -f -- "$2") ;;
    --output | --resume) mapfile -t COMPREPLY < <(compgen -d -- "$2") ;;
    --from) mapfile -t COMPREPLY < <(compgen -W "$("${COMP_WORDS[0]}" new 2>/dev/null | cut -d ' ' -f 1)" -- "$2") ;;
    --friction) mapfile -t COMPREPLY < <(compgen -W "off regularised" -- "$2") ;;
    --base) mapfile -t COMPREPLY < <(compgen -W "floating" -- "$2") ;;
    --verify) mapfile -t COMPREPLY < <(compgen -W "complex_step ridders" -- "$2") ;;
    *) COMPREPLY=() ;;
  esac
}

_codesign() {
  local word=${COMP_WORDS[COMP_CWORD]} previous=${COMP_WORDS[COMP_CWORD - 1]} command=${COMP_WORDS[1]-} options
  shopt -q extglob || return 0
  if [ "$COMP_CWORD" -eq 1 ] || [ "$command" = help ]; then
    mapfile -t COMPREPLY < <(compgen -W "$("${COMP_WORDS[0]}" help 2>/dev/null | grep -oE '^  ([a-z]+|--version) ') --help" -- "$word")
    return
  fi
  # readline splits --verify=ridders in three.
  if [ "$previous" = "=" ]; then
    _codesign_value "${COMP_WORDS[COMP_CWORD - 2]}" "$word"
    return
  fi
  # One line per option; ` X` follows those with a value. `apply` is a program of its own.
  local help=(help "$command")
  [ "$command" = apply ] && help=(apply --help)
  options=$("${COMP_WORDS[0]}" "${help[@]}" 2>/dev/null | grep -oE '(^ +|, )--?[a-z][a-z-]*( [A-Z]|=)?' | sed -E 's/^[ ,]+//; s/=$//; s/ [A-Z]$/ X/')
  if grep -qxe "$previous X" <<< "$options"; then
    _codesign_value "$previous" "$word"
  elif [[ $word == -* ]]; then
    mapfile -t COMPREPLY < <(compgen -W "${options// X/} --help" -- "$word")
  elif [ "$command" = new ]; then
    COMPREPLY=()
  elif [ "$command" = report ]; then
    mapfile -t COMPREPLY < <(compgen -f -X '!*.@(bag|json)' -- "$word"; compgen -d -- "$word")
  elif [ "$command" = apply ]; then
    mapfile -t COMPREPLY < <(compgen -f -X '!*.bag' -- "$word"; compgen -d -- "$word")
  else
    mapfile -t COMPREPLY < <(compgen -f -X '!*.@(urdf|xml|yaml|yml)' -- "$word"; compgen -d -- "$word")
  fi
}

shopt -s extglob
complete -o filenames -F _codesign codesign
