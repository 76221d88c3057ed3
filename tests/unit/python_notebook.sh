# ctest-labels: ci
# The package of python/ as users install it, in a fresh virtual environment over Debian's packages: its version, its frames, its figures,
# and the notebook of docs/, cell by cell.
. tests/support/campaigns.sh

export FRACAS="$fracas"
for name in h5py pandas xarray matplotlib nbclient ipykernel setuptools wheel venv; do
    /usr/bin/python3 -c "import $name" 2>/dev/null || { echo "skipped: python3-$name is not installed"; exit 0; }
done
mkdir tree
cp -r "$source/python" "$source/CMakeLists.txt" tree # pip builds in the folder
/usr/bin/python3 -m venv --system-site-packages venv
expect 0 venv/bin/pip install --no-index --no-build-isolation ./tree/python
expect 0 venv/bin/python -m ipykernel install --sys-prefix

campaign one.yaml 3 '1e5, 2e5'
expect 0 "$fracas" run --no-report one.yaml --study one --jobs 2
MPLBACKEND=Agg expect 0 venv/bin/python -W error "$source/tests/support/check_python_frames.py"
expect 0 venv/bin/python -c 'if 1:
    import nbclient, nbformat, sys
    notebook = nbformat.read(sys.argv[1], 4)
    nbformat.validate(notebook)
    nbclient.NotebookClient(notebook, timeout=600).execute()
    outputs = [output for cell in notebook.cells for output in cell.get("outputs", [])]
    assert sum("image/png" in output.get("data", {}) for output in outputs) == 3 and not any(output.output_type == "error" for output in outputs)
    ' "$source/docs/examples/sizes-of-a-bar.ipynb"
