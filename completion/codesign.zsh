# Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
# Completion of `codesign` in zsh; `. devel/setup.zsh` loads it if compinit has run.

_codesign() {
  local -a shared options
  shared=('*--overlay[annotations to merge into the model]:overlay:_files -g "*.(urdf|xml)"'
          '--result[take the design of a result.json]:result:_files -g "*.json"'
          '*--set[replace the value of a parameter]:PARAMETER=VALUE:'
          '--json[one JSON object on standard output]' '--quiet[no progress]' '--help[the options]')
  if (( CURRENT == 2 )); then
    _values 'command' 'check[equations and redundant constraints]' 'urdf[the URDF that is simulated]' 'simulate[one run as CSV]' \
      'efforts[the efforts that a motion or postures need]' 'equilibrium[a posture at rest and its stability]' \
      'gradient[objective and gradient]' 'optimize[tune the parameters of the study]' 'identify[fit parameters to recordings]' 'excite[find the motion to record]' \
      'new[a project from the gallery]' 'report[a page of what a job has found]' 'apply[send gains to a running robot]' 'help[the options]' '--help' '--version'
    return
  fi
  case ${words[2]} in
    urdf) options=('--sticks[sticks for links without visual]' '--fill[write the plain numbers beside expressions]') ;;
    simulate|efforts) options=('--signals[the signals to print]:signals:' '--csv[the file to write]:file:_files' '--samples[number of instants]:number:' '--run[one run of the study]:run:') ;;
    equilibrium) options=('--signals[the signals to print]:signals:' '--run[one run of the study]:run:') ;;
    gradient) options=('--verify=-[compare with a reference]::method:(complex_step ridders)' '--run[one run of the study]:run:') ;;
    optimize) options=('--output[folder of the results]:folder:_files -/' '--resume[go on with the job of a folder]:folder:_files -/') ;;
    identify|excite) options=('--output[folder of the results]:folder:_files -/') ;;
    help)
      _arguments '1:command:' '2:command:(check urdf simulate efforts equilibrium gradient optimize identify excite new report apply)'
      return
      ;;
    new)
      _arguments '1:command:' '2:folder:' "--from[machine of the gallery]:machine:($(codesign new 2>/dev/null | cut -d ' ' -f 1 | tr '\n' ' '))" '--json[one JSON object]' '--quiet[no progress]' '--help[the options]'
      return
      ;;
    report)
      _arguments '1:command:' '2:job:_files -g "*.bag(-.) *(-/)"' '(-o --output)'{-o,--output}'[the page]:file:_files' '--help[the options]'
      return
      ;;
    apply)
      _arguments '1:command:' '2:job:_files -g "*.bag(-.) *(-/)"' '--dry-run[send nothing]' '--server[server of the parameters]:namespace:' \
        '--ramp[seconds]:seconds:' '--hold[seconds]:seconds:' '*--limit[range of a signal]:SIGNAL=LOW\:HIGH:' '--deviation[of positions]:number:' \
        '--joint-states[topic]:topic:' '--max-age[seconds]:seconds:' '--unwatched[without joint states]' '--json[one JSON object]' '--help[the options]'
      return
      ;;
  esac
  _arguments '1:command:' '2:model:_files -g "*.(urdf|xml)"' '3:study:_files -g "*.(yaml|yml)"' $shared $options
}

if (( $+functions[compdef] )); then compdef _codesign codesign; fi
