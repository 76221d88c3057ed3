# ctest-labels: ci
# The JSON schema of campaign files takes every file that fracas takes, and refuses typical mistakes at the same line.
. tests/support/campaigns.sh
"$fracas" reference --schema > schema.json
cd "$source"
/usr/bin/python3 tests/support/check_schema.py "$(dirname "$fracas")/libfracas.so" "$work/schema.json" campaigns/examples/*.yaml docs/examples/*.yaml tests/fuzz/corpus/campaign_file/*
