# No kernel has lost more than 10 % of its speed beside the multiply-add loop (bench/kernel-ratios.json).
# ctest-labels: storm
# ctest-serial
/usr/bin/python3 bench/check_kernels.py "$1/fracas"
