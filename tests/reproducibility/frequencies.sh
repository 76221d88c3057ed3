# The processes of a run take frequencies from its launcher: twice as high ones halve the time step. Without any, or with wrong text,
# they compute their own: the same study.h5.
. tests/support/campaigns.sh

cat > plate.yaml <<'END'
name: plate
seed: 3
model: membrane
geometry: {shape: plate, width: 10 mm, height: 5 mm, thickness: 0.1 mm}
mesh: {divisions: 6}
material: {young: 370 GPa, poisson: 0.25, density: 3900 kg/m3}
cohesive: {fracture_energy: 50 J/m2}
strength: {minimum: 264 MPa, scale: 50 MPa, shape: 2}
loading: {rate: 1e5 1/s}
time: {stop: time, end: 0.4 us}
replicas: 2
END

# An mpirun before the real one: it changes the launcher's frequencies by $change.
mkdir bin
cat > bin/mpirun <<END
#!/usr/bin/python3
import os, sys
body, whole, pressed = os.environ["FRACAS_FREQUENCIES"].rstrip(",").split(":")
double = lambda hexadecimal: (2 * float.fromhex(hexadecimal)).hex()
os.environ["FRACAS_FREQUENCIES"] = {
    "double": f"{body}:{double(whole)}:{double(pressed)},",
    "none": "",
    "odd": f"{body}:{whole}",
}[os.environ["change"]]
os.execv("$(command -v mpirun)", ["mpirun"] + sys.argv[1:])
END
chmod +x bin/mpirun

# time_step STUDY: of its first realization [s]
time_step()
{
    h5dump -m %.17g -d /realization/time_step "$1/study.h5" | sed -n 's/.*(0): \([^,]*\),.*/\1/p'
}

expect 0 "$fracas" run --no-report plate.yaml --study plain
for change in none odd double; do
    expect 0 env change=$change FRACAS_MPIRUN=1 PATH="$work/bin:$PATH" "$fracas" run --no-report plate.yaml --study $change
done
same plain none
same plain odd
/usr/bin/python3 -c "assert $(time_step plain) == 2 * $(time_step double) > 0" || fail "the frequencies were not taken"
