#!/bin/sh
# Values of no sense, as of a unit that was forgotten, are refused with their place and in a line that can be read: no number of 300
# digits, none that is no number, no remedy that is none.
. tests/support/campaigns.sh

campaign bar.yaml 2 '1e5 1/s'
sed -i '/^sweep:/,/^ /d' bar.yaml
cat > plate.yaml <<END
name: plate
seed: 1
model: membrane
geometry: {shape: plate, height: 10 mm, width: 10 mm, thickness: 1 mm}
mesh: {divisions: 4}
material: {young: 275 GPa, density: 2750 kg/m3, poisson: 0.25}
cohesive: {law: nitsche, fracture_energy: 100 J/m2}
strength: {distribution: uniform, minimum: 299 MPa, maximum: 301 MPa}
loading: {type: expansion, rate: 1e4 1/s}
time: {stop: time, end: 300 ns, safety: 0.25}
replicas: 1
END

# absurd FILE SED WORDS: by `plan` and by `run`.
absurd()
{
    sed "$2" "$1" > absurd.yaml
    for command in plan run; do
        expect 2 "$fracas" $command absurd.yaml
        said "^fracas: \(absurd.yaml:[0-9]*:[0-9]*\|point 0\): .*$3"
        ! grep -E 'nan|inf |above 0|[0-9]{20}' said || fail "$2: $(cat said)"
        [ "$(wc -c < said)" -lt 500 ] || fail "$2: $(wc -c < said) characters"
    done
}

absurd bar.yaml 's/275 GPa/1e300/; s/2750 kg.m3/1e-300/; s/length: 10 mm/length: 1e300/' '`length`: 1e+300 m is beyond .*1e-100 to 1e100'
absurd bar.yaml 's/301 MPa/1e-300/' '`maximum`: 1e-300 Pa is beyond'
absurd bar.yaml 's/100 J.m2/1e300/' '`fracture_energy`: 1e+300 J/m2 is beyond'
absurd bar.yaml 's/275 GPa/1e100/; s/2750 kg.m3/1e-100/; s/length: 10 mm/length: 1e-100/' 'time step of 0 s: are young, density'
absurd bar.yaml 's/275 GPa/1e60/' 'time.end 3e-07 s is .* time steps .*in the units meant'
absurd bar.yaml 's/100 J.m2/1e-90/' 'raise mesh.elements above 4.1.*e+92 .*in the units meant'
absurd plate.yaml 's/thickness: 1 mm/thickness: 1e-300/' '`thickness`: 1e-300 m is beyond'
