# 135 000 disk states that a power cut may leave of five campaigns, opened in process, and 1250 ended by the same command. Then 4000 of
# runs that went on after a cut.
# ctest-labels: storm
# ctest-timeout: 14400
. tests/support/campaigns.sh
. "$source/tests/support/power_loss.sh"
seed=${FRACAS_STORM_SEED:-1}
opened=${FRACAS_POWER_STATES:-27000}
ended=${FRACAS_POWER_ENDED:-250}

# storm NAME CAMPAIGN [MORE]: `fracas run` of the campaign ends every study with the bytes of whole-NAME.
storm()
{
    states "$1" "$2" "whole-$1/study.h5" "$opened" "$seed" 2 || fail "$1: a power cut loses what was done"
    states "$1" "$2" "whole-$1/study.h5" "$ended" "$seed" 2 \
        "${3:-$fracas} run $(pwd)/$2 --study study --jobs 1 ${4-} > said 2>&1 || { s=\$?; [ \$s -eq ${5:-0} ] || { cat said; exit \$s; }; }" ||
        fail "$1: the same command does not end well"
}

record_bar
storm bar bar-long.yaml
changes=$("$power_loss" list bar.log | wc -l)
for part in 1 2 3 4; do
    record_twice $((changes * part / 5)) "$seed$part"
    states twice bar-long.yaml whole-bar/study.h5 1000 "$seed" 2 || fail "a second power cut, after one at $part/5 of the bar, loses what was done"
done
record_rule
export FRACAS_TEST_FAULT=crash:0:1
storm rule rule.yaml "$faulty" '' 1
unset FRACAS_TEST_FAULT
record_surfaces
export DISK_NETWORK=1
storm surfaces surfaces.yaml "env LD_PRELOAD=$recorder $fracas" --force
unset DISK_NETWORK
record_long
storm long long.yaml
record_upkeep
storm upkeep upkeep-long.yaml
