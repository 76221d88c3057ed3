# ctest-labels: ci
# Manual pages and completions come from the tables of --help: every command and option that --help has is in all of them, roff finds
# nothing wrong, and bash completes with them.
. tests/support/campaigns.sh

for shell in bash zsh fish; do
    "$fracas" completion $shell > $shell
done
bash -n bash
expect 2 "$fracas" completion tcsh
said 'unknown shell `tcsh`; there are bash, zsh, fish'
expect 2 "$fracas" man rum
said 'did you mean `run`'

"$fracas" help | sed -n 's/^  fracas \([a-z][a-z-]*\).*/\1/p' | grep -vx help > commands
[ "$(wc -l < commands)" -gt 20 ] || fail "--help names few commands"
"$fracas" man fracas > page
man --warnings -l page > /dev/null 2> warnings
[ ! -s warnings ] || fail "$(cat warnings)"
MANWIDTH=200 man -l page > program
"$fracas" --help | sed 's/^ *fracas help.*//' > help
checked=0
while read -r command; do
    grep -q "fracas $command" program || fail "man fracas has no $command"
    "$fracas" man "$command" > page
    man --warnings -l page > /dev/null 2> warnings
    [ ! -s warnings ] || fail "man $command: $(cat warnings)"
    MANWIDTH=300 man -l page | sed 's/‐/-/g; s/−/-/g' > text
    sed -n "/^    $command)/,/^        ;;/p" bash > bash.here
    sed -n "/^    $command)/,/^        ;;/p" zsh > zsh.here
    grep "__fish_seen_subcommand_from $command'" fish > fish.here || true
    for option in $("$fracas" help "$command" | sed -n 's/^  --\([a-z-]*\).*/\1/p'); do
        grep -q -- "^ *--$option\>" text || fail "man $command has no --$option"
        grep -q -- " --$option\>" bash.here || fail "bash completes no --$option of $command"
        grep -q -- "'--$option\[" zsh.here || fail "zsh completes no --$option of $command"
        grep -q -- " -l $option\>" fish.here || fail "fish completes no --$option of $command"
        checked=$((checked + 1))
    done
    for words in bash.here text; do # and no other
        for option in $(grep -o -- '^ *--[a-z][a-z-]*\| --[a-z][a-z-]*' $words | sort -u | sed 's/.*--//'); do
            [ "$words:$option" = text:help ] || [ "$option" = help ] || [ $words = text ] ||
                "$fracas" help "$command" | grep -q -- "^  --$option\>" || fail "$words of $command has --$option, which it does not know"
        done
    done
done < commands
[ $checked -gt 100 ] || fail "only $checked options"

# Each shell completes a line to the same words.
cat > complete.bash <<'BASH'
. ./bash
read -r -a COMP_WORDS <<< "$1"
[ "${1% }" = "$1" ] || COMP_WORDS+=('')
COMP_CWORD=$((${#COMP_WORDS[@]} - 1))
_fracas
printf '%s\n' "${COMPREPLY[@]}"
BASH
cat > complete.fish <<'FISH'
complete -c fracas -e
source ./fish
complete -C "$argv[1]" | string replace -r '\t.*' ''
FISH
# A zsh at a prompt gets the line and a tab; its matches are noted where they are added.
mkdir functions
ln -s ../zsh functions/_fracas
cat > complete.zsh <<'ZSH'
zmodload zsh/zpty
: > matches
zpty z zsh -f -i
zpty -w z 'fpath=($PWD/functions $fpath); autoload -Uz compinit; compinit -D -u; source ./noted.zsh'
zpty -n -w z "$1"$'\t'
while zpty -r z line; do :; done
cat matches
ZSH
cat > noted.zsh <<'ZSH'
compadd()
{
    if [[ ${@[1,(i)(-|--)]} == *-(O|A|D)\ * ]]; then builtin compadd "$@"; return; fi
    local -a found
    builtin compadd -A found "$@"
    print -r -l -- ${(Q)found} >> matches
}
finish() { exit }
comppostfuncs=(finish)
bindkey '^I' complete-word
ZSH
mkdir folder
: > 'folder/a b.yaml'
shells=
for shell in bash zsh fish; do
    if command -v $shell > /dev/null; then shells="$shells $shell"; else echo "skipped: $shell is not installed"; fi
done
# completes WANTED LINE: the last word of LINE, as typed.
completes()
{
    for shell in $shells; do
        found=$(timeout 60 $shell complete.$shell "$2" < /dev/null | sed 's|^folder/||; /^$/d' | LC_ALL=C sort -u | tr '\n' ' ')
        [ "${found% }" = "$1" ] || fail "$shell completes '$2' to '$found', not '$1'"
    done
}
completes 'merge merge-studies' 'fracas mer'
completes '--lanes --lease-limit --lease-time' 'fracas run --l'
completes 'lease' 'fracas run --isolation l'
completes 'baseline' 'fracas run f.yaml --isa b'
completes 'material.density material.poisson material.young' 'fracas compare A B --by material.'
completes 'a b.yaml' 'fracas plan folder/'
completes 'a b.yaml' 'fracas run --study folder/'
completes '' 'fracas run --jobs x'
completes '' 'fracas run --jobs '
completes 'bash' 'fracas completion b'
completes 'ring' 'fracas init r'
completes 'kernels' 'fracas bench k'
completes 'a b.yaml' 'fracas picture S -o folder/'
completes 'verify' 'fracas help ve'
