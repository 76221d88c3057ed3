# A million leases of a millisecond, with a kill every second: memory, open files and the index stay as they are (tests/support/soak.py).
# ctest-labels: storm
# ctest-timeout: 7200
. tests/support/campaigns.sh

/usr/bin/python3 "$source/tests/support/soak.py" "$fracas" "$work" "${FRACAS_SOAK_LEASES:-1000000}"
expect 0 "$fracas" verify soak
