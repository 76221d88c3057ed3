# ctest-sanitize
# Among the processes of somebody else's MPI job: a task farm, a rank that starts fracas alone, two runs in one process.
. tests/support/campaigns.sh

campaign small.yaml 8 '1e5 1/s'
expect 0 "$fracas" run --no-report small.yaml --study undisturbed --jobs 1
script() { # script FILE: what each process of the job does, from standard input
    cat > "$1"
    chmod +x "$1"
}

# Each process gives a study of its own: by name, or by its folder. Neither is begun.
script farm << END
#!/bin/sh
exec "$fracas" run --no-report small.yaml --study farm\$OMPI_COMM_WORLD_RANK
END
expect 2 launch -n 2 ./farm
said '^fracas: rank 1 would compute another study than rank 0, .* give all the same, or start a run for each study'
script folders << END
#!/bin/sh
mkdir in\$OMPI_COMM_WORLD_RANK && cd in\$OMPI_COMM_WORLD_RANK && exec "$fracas" run ../small.yaml
END
expect 2 launch -n 3 ./folders
said '^fracas: rank 1 would compute another study than rank 0'
[ -z "$(ls -d farm[01] in[012]/* 2> /dev/null)" ] || fail "a study was begun: $(ls -d farm[01] in[012]/*)"
# Two names of one folder are one study.
ln -s . here
script names << END
#!/bin/sh
case \$OMPI_COMM_WORLD_RANK in 0) study=one/ ;; 1) study=.//one ;; *) study=$PWD/here/./one ;; esac
exec "$fracas" run --no-report small.yaml --study \$study
END
expect 0 launch -n 3 ./names
same undisturbed one

# The other process never comes: it ends when fracas has said that it waits for it.
script alone << END
#!/bin/sh
case \$OMPI_COMM_WORLD_RANK in
0) exec "$fracas" run --no-report small.yaml --study lonely 2> waiting ;;
*) until grep -q '^fracas: waits for 1 more process of the mpirun .* OMPI_\*, PMIX_\* and PMI_\*' waiting; do sleep 0.1; done ;;
esac
END
launch -n 2 ./alone > background 2>&1 &
wait $! && fail "a run without its other process ended well"
grep -q '^fracas: waits for 1 more' waiting || fail "nothing was said of the process that does not come"
[ ! -e lonely ] || fail "a study was begun"

# Two runs in one process of the job: MPI starts once in it. The second does with the variables of the job taken out.
script twice << END
#!/bin/sh
"$fracas" run --no-report small.yaml --study first || exit 20
"$fracas" run --no-report small.yaml --study second
echo "status \$?"
"$fracas" run --no-report nothing.yaml --study second
echo "then status \$?"
(unset \$(env | grep -oE '^(OMPI|PMIX|PMI|SLURM_STEP)_\w*'); "$fracas" run --no-report small.yaml --study third --jobs 1) || exit 21
END
expect 0 launch -n 1 ./twice
said '^fracas: MPI does not start, see above: .* OMPI_\*, PMIX_\* and PMI_\* .*out of its environment'
said '^status 6$'
said '^fracas: .*nothing.yaml' # what is wrong with the run itself comes first
said '^then status 2$'
[ ! -e second ] || fail "a study was begun"
same undisturbed first
same undisturbed third
