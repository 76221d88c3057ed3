#!/bin/sh
# tools/check-words: the tree obeys; each fault that it counts is found where it is planted, and its counts are those made by hand.
set -eu

tools/check-words

tree=$(mktemp -d)
trap 'rm -rf "$tree"' EXIT

# A small tree that is in order, with every form that a comment and a page may have: 500 words of comments, 4 of them
# "that", none "what"; 20 sentences.
fresh() {
    rm -rf "${tree:?}"/*
    mkdir -p "$tree/base" "$tree/engine/mesh" "$tree/docs/how-to" "$tree/docs/formats"
    {
        echo '/* SPDX-License-Identifier: GPL-3.0-or-later */'
        echo '/* The length l_e of an element [m], that is'
        echo ' * h/2, e.g. of a bar. */'
        echo 'static const char *text = "/* What */ is \" no // comment", c = '"'\"'"'; /* and that too */'
        echo '// Two lines'
        echo '// that go on.'
        echo 'int a = b / c; // That-much is one word, and that too'
    } >"$tree/base/one.h"
    { # 30 words there, 470 here
        echo '/* Of-course */'
        words 469
    } >"$tree/engine/mesh/two.c"
    {
        echo '# What a heading may say: it is no sentence that is counted'
        for number in 1 2 3 4 5 6 7 8 9 10; do
            echo "- You see item number $number. It is not long, e.g. as J. Doe wrote, nor is \`study.h5 or a. b c\`."
        done
        echo
        echo 'A sentence, over'
        echo 'two lines.'
        echo
        echo '    What is code. What is code'
        echo
        echo '```'
        echo 'What is code. What is code'
        echo '```'
        echo '| What is a table | Of cells |'
        echo '<!-- generated: by nobody -->'
        echo 'What is here counts for nothing.'
        echo '<!-- end of generated -->'
    } >"$tree/docs/how-to/go.md"
    echo 'What is here counts for nothing.' >"$tree/docs/formats/campaign-file-keys.md"
    printf 'A paragraph that runs over\nmany lines. Here it ends at last.\n' >"$tree/README.md"
}

# A comment of $1 words.
words() {
    echo '/*'
    seq "$1" | sed 's/.*/ * word/'
    echo ' */'
}

# A sentence of $1 words, over lines.
sentence() {
    seq 2 "$1" | sed 's/.*/word/' | sed '1s/^/Every /; $s/$/./'
}

# After the line $2 at the end of file $1, "$3" is listed and "$4" is the only limit that is exceeded.
plant() {
    fresh
    echo "$2" >>"$tree/$1"
    if tools/check-words --list "$tree" >"$tree/found" || ! grep -qF "$3" "$tree/found" ||
        [ "$(grep '^check-words: ' "$tree/found")" != "check-words: $4
check-words: 1 of 7 limits exceeded" ]; then
        echo "planted in $1; expected: $3; found:"
        cat "$tree/found"
        exit 1
    fi
}

fresh
tools/check-words "$tree" >"$tree/found" || { cat "$tree/found"; exit 1; }
for line in 'all *500 *8\.0 *0\.0 *0' '\. *12 *2 *0\.0 *0' 'docs/how-to *261 *21 *0\.0 *0' 'all *273 *23 *0\.0 *0'; do
    grep -qx "$line" "$tree/found" || { echo "not found: $line"; cat "$tree/found"; exit 1; }
done

plant base/one.h '/* so that one */' 'base/one.h:8: that: so that one' '9.9404 "that" per 1000 words of comments, the limit is 8'
plant base/one.h '/* see what */' 'base/one.h:8: what: see what' '1.992 "what" per 1000 words of comments, the limit is 1'
plant engine/mesh/two.c '// of the elements' 'engine/mesh/two.c:473: opens with: of the elements' \
    '1 comments open with What, Of or That, the limit is 0'
plant engine/mesh/two.c '/*
 * A sentence (in brackets.)
 * Of another
 * one. */' 'engine/mesh/two.c:475: opens with: Of another one.' '1 comments open with What, Of or That, the limit is 0'
plant README.md '
1. Here. "Of one it is."' 'README.md:4: opens with: "Of one it is."' '1 sentences of pages open with What, Of or That, the limit is 0'
plant docs/how-to/go.md "
First. $(sentence 36)" 'docs/how-to/go.md:26: 36 words: Every word' '4.1667 % of the sentences have more than 35 words, the limit is 4'
plant docs/how-to/quiet.md 'A page for nobody.' 'docs/how-to/quiet.md:1: without you' '1 pages of docs/how-to without "you", the limit is 0'
plant docs/formats/long.md "# $(seq 93727 | tr '\n' ' ')" 'docs/formats' '94001 words in pages, the limit is 94000'

fresh
printf '\n%s\n' "$(sentence 35)" >>"$tree/README.md"
tools/check-words "$tree" >"$tree/found" || { cat "$tree/found"; exit 1; }
