# bash completion of balloon-sculpt, balloon-surface and balloon-sim.
#
# Options, what they take, and a scene's keys are read off the program's own --help and --help-scene when they are asked
# for, so that no list here can fall behind. What stands here are the words of a few options, and what programs open.

# A line for each option: "- --movie FILE Make a movie (.mp4, ...)" or "-q --quiet - No notes"; [N] for what may be left out.
_balloon_options() # PROGRAM
{
    "$1" --help 2>/dev/null | awk '
        function flush() { if (long != "") print short, long, argument, help; long = "" }
        /^ *$/ { flush() }
        /^ +(-., )?--/ {
            flush()
            short = $1 ~ /^-.,$/ ? substr($1, 1, 2) : "-"
            long = $1 ~ /^-.,$/ ? $2 : $1
            argument = "-"
            if (match(long, /=/)) {
                argument = substr(long, RSTART + 1)
                long = substr(long, 1, RSTART - 1)
                if (sub(/\[$/, "", long))
                    argument = "[" argument
            }
            help = $0
            sub(/^ +(-., )?--[^ ]+ */, "", help)
            next
        }
        long != "" { sub(/^ +/, ""); help = help " " $0 }
        END { flush() }'
}

# A line for each key of a scene as --set takes it, balloons[].rip.at, and behind it the words that it can be.
_balloon_keys() # PROGRAM
{
    "$1" --help-scene 2>/dev/null | awk '
        /^[a-z][^ ]*: / { block = $1; sub(/:$/, "", block) }
        block != "" && /^  [a-z_]+ / { key = block "." $1; next }
        key != "" {
            words = ""
            sub(/, default .*/, "")
            if ($1 == "one")
                while (match($0, /"[^"]*"/)) {
                    words = words " " substr($0, RSTART + 1, RLENGTH - 2)
                    $0 = substr($0, RSTART + RLENGTH)
                }
            print key words
            key = ""
        }'
}

# Folders, and the files that have one of these extensions; without any, all files.
_balloon_files() # CURRENT EXTENSION...
{
    local file extension extensions=" ${*:2} "
    compopt -o filenames 2>/dev/null
    while IFS= read -r file; do
        extension=${file##*.}
        if [[ -d $file || $extensions == *' '" " || $extensions == *" ${extension,,} "* ]]; then
            COMPREPLY+=("$file")
        fi
    done < <(compgen -f -- "$1")
}

# KEY=VALUE: keys a level at a time, then the words that the key can be.
_balloon_set() # PROGRAM CURRENT
{
    local current=$2 key words path list index
    while read -r key words; do
        path=$key
        while [[ $path == *'[]'* ]]; do # with the number that was typed, or the first
            list=${path%%'[]'*}
            index=0
            [[ $current =~ ^"$list["([0-9]+)\] ]] && index=${BASH_REMATCH[1]}
            path="$list[$index]${path#*'[]'}"
        done
        if [[ $current == "$path="* ]]; then
            mapfile -t COMPREPLY < <(compgen -P "$path=" -W "$words" -- "${current#*=}")
        elif [[ $path == "$current"* ]]; then
            compopt -o nospace 2>/dev/null
            list=${path#"$current"}
            if [[ $list == *.* ]]; then
                path=$current${list%%.*}.
            else
                path+==
            fi
            [[ " ${COMPREPLY[*]} " == *" $path "* ]] || COMPREPLY+=("$path")
        fi
    done < <(_balloon_keys "$1")
}

# The value of an option.
_balloon_value() # PROGRAM CURRENT OPTION ARGUMENT HELP
{
    local extensions
    case $3=$4 in
    --seeds=*) mapfile -t COMPREPLY < <(compgen -W 'descent random' -- "$2") ;;
    --fields-per-cube=*) mapfile -t COMPREPLY < <(compgen -W 'exact 0 1 8 27 64' -- "$2") ;;
    --mesh-series-format=*) mapfile -t COMPREPLY < <(compgen -W 'ply vtp' -- "$2") ;;
    *=KEY=VALUE) _balloon_set "$1" "$2" ;;
    *=DIR)
        compopt -o filenames 2>/dev/null
        mapfile -t COMPREPLY < <(compgen -d -- "$2")
        ;;
    *=FILE*) # of the kinds that the help names: FILE.oct, or "(.mp4, .webm or .gif)"
        extensions=$(grep -oE '(^FILE|[ (])\.[a-z][a-z0-9]+' <<<"$4 $5" | sed 's/.*\.//')
        # shellcheck disable=SC2086 # words they are
        _balloon_files "$2" $extensions
        ;;
    esac
}

_balloon()
{
    local program=${1/#\~/$HOME} current='' previous='' i short long argument help options=()
    COMPREPLY=()
    # bash parts words at "=": --log=FILE, KEY=VALUE. Here they are whole.
    for ((i = 1; i <= COMP_CWORD; i++)); do
        if [[ $i -gt 1 && (${COMP_WORDS[i]} == =* || $current == *=) ]]; then
            current+=${COMP_WORDS[i]}
        else
            previous=$current
            current=${COMP_WORDS[i]}
        fi
    done

    while read -r short long argument help; do
        if [[ $current == "$long="* && $argument != - ]]; then
            _balloon_value "$program" "${current#*=}" "$long" "${argument//[][]/}" "$help"
            COMPREPLY=("${COMPREPLY[@]/#/$long=}")
            options=()
            break
        elif [[ ($previous == "$long" || $previous == "$short") && $argument != - && $argument != '['* ]]; then
            _balloon_value "$program" "$current" "$long" "$argument" "$help"
            options=()
            break
        fi
        options+=("$long")
    done < <(_balloon_options "$program")

    if [[ ${#options[@]} != 0 && $current == -* ]]; then
        mapfile -t COMPREPLY < <(compgen -W "${options[*]}" -- "$current")
    elif [[ ${#options[@]} != 0 ]]; then
        case ${program##*/} in
        balloon-sim) _balloon_files "$current" cfg ply stl obj gltf glb dae fbx 3ds off blend ;;
        *) _balloon_files "$current" oct ;;
        esac
    fi
    # what is typed up to the last "=" stands there already
    if [[ $current == *=* && $COMP_WORDBREAKS == *=* ]]; then
        COMPREPLY=("${COMPREPLY[@]#"${current%=*}="}")
    fi
}

complete -F _balloon balloon-sculpt balloon-surface balloon-sim
