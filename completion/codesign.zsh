# Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
# Completion of `codesign` in zsh; `. devel/setup.zsh` loads it if compinit has run. Commands and options are those of the program's own help.

_codesign() {
  local -a commands options
  local line name value action
  if (( CURRENT == 2 )) || [[ ${words[2]} == help ]]; then
    for line in ${(f)"$(${words[1]} help 2>/dev/null)"}; do
      [[ $line =~ '^  ([a-z]+|--version) .*   ?(.*)$' ]] && commands+=("$match[1]:$match[2]")
    done
    _describe command commands
    return
  fi
  # `apply` is a program of its own.
  [[ ${words[2]} == apply ]] && line='apply --help' || line="help ${words[2]}"
  for line in ${(f)"$(${words[1]} ${=line} 2>/dev/null)"}; do
    [[ $line =~ '^ +(--?[a-z][a-z-]*)([ =][A-Z][^ ]*)?,?  +(.*)$' ]] || continue
    name=$match[1] value=${match[2]//:/\\:} line=${${match[3]//\[/\\[}//\]/\\]}
    case $name in
      --overlay) action='_files -g "*.(urdf|xml)"' ;;
      --result) action='_files -g "*.json"' ;;
      --csv|-o) action=_files ;;
      --output|--resume) action='_files -/' ;;
      --from) action="($(${words[1]} new 2>/dev/null | cut -d ' ' -f 1 | tr '\n' ' '))" ;;
      --friction) action='(off regularised)' ;;
      --base) action='(floating)' ;;
      --verify) action='(complex_step ridders)' ;;
      *) action=' ' ;;
    esac
    case $value in
      '') options+=("*${name}[$line]") ;;
      '='*) options+=("*$name=-[$line]:${value#=}:$action") ;;
      *) options+=("*${name}[$line]:${value# }:$action") ;;
    esac
  done
  case ${words[2]} in
    new) _arguments '1:command:' '2:folder:' $options ;;
    report) _arguments '1:command:' '2:job:_files -g "*.(bag|json)(-.) *(-/)"' $options ;;
    apply) _arguments '1:command:' '2:job:_files -g "*.bag(-.) *(-/)"' $options ;;
    *) _arguments '1:command:' '2:model:_files -g "*.(urdf|xml)"' '3:study:_files -g "*.(yaml|yml)"' $options '--help[the options]' ;;
  esac
}

if (( $+functions[compdef] )); then compdef _codesign codesign; fi
