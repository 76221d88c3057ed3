/* SPDX-License-Identifier: GPL-3.0-or-later */
/* base/units: strict numbers, units to SI, 15 digits. */
#include "base/units.h"
#include "tests/support/test.h"

#include <locale.h>

#define COUNT(array) (sizeof(array) / sizeof *(array))

static int load(void **state)
{
    fracas_units *units;
    if (fracas_units_create(&units)) return -1;
    *state = units;
    return 0;
}

static int unload(void **state)
{
    fracas_units_destroy(*state);
    return 0;
}

/* Values are compared with ==: after rounding to 15 digits, the double is the one nearest to the
 * decimal. */
static void check_values(const fracas_units *units)
{
    static const struct {
        const char *text, *si;
        double value;
    } good[] = {
        {"264 MPa", "Pa", 264e6},
        {"275 GPa", "Pa", 275e9},
        {"0.1 mm", "m", 1e-4},
        {"1e4 1/s", "1/s", 1e4},
        {"1e4 s-1", "1/s", 1e4},
        {"1e4 s^-1", "1/s", 1e4},
        {"1e4 Hz", "1/s", 1e4},
        {"100 J/m2", "J/m2", 100},
        {"100 J/m^2", "J/m2", 100},
        {"100 N/m", "J/m2", 100},
        {"0.1 kJ/m2", "J/m2", 100},
        {"100 J m-2", "J/m2", 100},
        {"100 J/m\xc2\xb2", "J/m2", 100},
        {"2 us", "s", 2e-6},
        {"2 \xc2\xb5s", "s", 2e-6},
        {"2 \xce\xbcs", "s", 2e-6},
        {"300 ns", "s", 300e-9},
        {"1 mm2", "m2", 1e-6},
        {"2750 kg/m3", "kg/m3", 2750},
        {"2.75 g/cm3", "kg/m3", 2750},
        {"1 kg/(m s2)", "Pa", 1},
        {"5", "Pa", 5},
        {"6000 rad/s", "rad/s", 6000},
        {"6000 1/s", "rad/s", 6000},
        {"30 rpm", "rad/s", 3.14159265358979},
        {"0.5 turn/s", "rad/s", 3.14159265358979},
        {"0.5 cycles/s", "rad/s", 3.14159265358979},
        {"180 degrees/s", "rad/s", 3.14159265358979},
        {"+5.", "m", 5},
        {".5", "m", 0.5},
        {"-1.5e+3", "m", -1500},
        {"1E3 m", "m", 1000},
        {"5%", "1", 0.05},
        {"5 %", "1", 0.05},
        {"0.33 %", "1", 0.0033},
        {"0 MPa", "Pa", 0},
        {"-0 mm", "m", 0},
        {"0e999", "m", 0},
        {"1 mm.mm", "m2", 1e-6},
        {"36 km/hour", "m/s", 10},
        {"2 1/mm3", "1/m3", 2e9},
        {"2 mm-3", "1/m3", 2e9},
    };
    for (size_t i = 0; i < COUNT(good); i++) {
        double value = NAN;
        if (fracas_units_read(units, good[i].text, good[i].si, &value))
            fail_msg("%s: %s", good[i].text, fracas_message());
        if (value != good[i].value || signbit(value) != signbit(good[i].value))
            fail_msg("%s in %s: %.17g, expected %.17g", good[i].text, good[i].si, value,
                     good[i].value);
    }
}

static void test_values(void **state)
{
    check_values(*state);
}

/* A locale with a decimal comma, compiled here because a bare system has none. */
static bool set_comma_locale(const char *folder)
{
    char source[200], command[600];
    snprintf(source, sizeof source, "%s/comma.src", folder);
    FILE *out = fopen(source, "w");
    assert_non_null(out);
    fputs("comment_char %\nescape_char /\nLC_NUMERIC\ndecimal_point \",\"\nthousands_sep "
          "\".\"\ngrouping 3;3\n"
          "END LC_NUMERIC\n",
          out);
    assert_int_equal(fclose(out), 0);
    /* localedef's status is 1 for the categories that are left out. */
    snprintf(command, sizeof command, "localedef -c -i %s %s/comma >%s/log 2>&1 || true", source,
             folder, folder);
    assert_int_equal(system(command), 0);
    setenv("LOCPATH", folder, 1);
    return setlocale(LC_NUMERIC, "comma") != NULL;
}

/* A program that has set a locale with a decimal comma reads and writes the same. */
static void test_locale(void **state)
{
    char folder[] = "/tmp/fracas-locale-XXXXXX", command[100], text[FRACAS_NUMBER_TEXT],
         comma_text[8];
    assert_non_null(mkdtemp(folder));
    bool set = set_comma_locale(folder);
    snprintf(command, sizeof command, "rm -r %s", folder);
    assert_int_equal(system(command), 0);
    assert_true(set);
    fracas_number_write(0.5, text);
    check_values(*state);
    snprintf(comma_text, sizeof comma_text, "%g", 0.5); /* the program keeps its locale */
    setlocale(LC_NUMERIC, "C");
    assert_string_equal(comma_text, "0,5");
    assert_string_equal(text, "0.5");
}

static void test_refused(void **state)
{
    static const struct {
        const char *text, *si, *words[3]; /* which the message must have */
    } bad[] = {
        {"264 mm", "Pa", {"`264 mm` is a length", "expected a stress", "Pa or MPa"}},
        {"264 MPa", "m", {"is a stress", "expected a length", "m or mm"}},
        {"6 kHz", "rad/s", {"`6 kHz` may mean", "rad/s or rpm", ""}},
        {"6000 hertz", "rad/s", {"may mean", "rad/s or rpm", ""}},
        {"6000 Bq", "rad/s", {"may mean", "rad/s or rpm", ""}},
        {"6000 1/min", "rad/s", {"may mean", "rad/s or rpm", ""}},
        {"100 J", "J/m2", {"is an energy;", "expected an energy per area", "J/m2"}},
        {"1e4 s",
         "1/s",
         {"is a time", "expected a rate", "1/s"}}, /* udunits would take the reciprocal */
        {"5 W", "Pa", {"is a quantity in", "expected a stress", ""}},
        {"5 %", "Pa", {"`%`", "expected a stress", ""}},
        {"5 Mpa", "Pa", {"unknown unit, `Mpa`", "a stress", "Pa or MPa"}},
        {"264MPa", "Pa", {"`264MPa` is not a number", "a stress", "a space before the unit"}},
        {"12x", "1", {"`12x` is not a number", "a pure number", ""}},
        {"12x", "Pa", {"`12x` is not a number", "a stress", ""}},
        {"1e", "1", {"`1e` is not a number", "", ""}},
        {"1e+", "m", {"`1e+` is not a number", "", ""}},
        {"nan", "m", {"`nan` is not a number", "", ""}},
        {"inf", "m", {"`inf` is not a number", "", ""}},
        {"-infinity", "m", {"is not a number", "", ""}},
        {"0x10", "m", {"`0x10` is not a number", "", ""}},
        {"1,5 mm", "m", {"`1,5 mm` is not a number", "", ""}},
        {"1_000", "m", {"is not a number", "", ""}},
        {"", "m", {"`` is not a number", "a length", ""}},
        {" 5", "m", {"is not a number", "", ""}},
        {"-", "m", {"is not a number", "", ""}},
        {".", "m", {"is not a number", "", ""}},
        {"MPa", "Pa", {"`MPa` is not a number", "", ""}},
        {"1e400 m", "m", {"too large", "", ""}},
        {"1e-400 m", "m", {"too small", "", ""}},
        {"1e300 Gm", "m", {"too large", "", ""}},
        {"1e-300 nm2", "m2", {"too small", "", ""}},
        {"5 m", "1", {"`5 m` has a unit", "a pure number", ""}},
        {"5 rad", "1", {"has a unit", "", ""}},
        {"5 s since 2000-01-01", "s", {"unknown unit", "", ""}},
        {"5 s from 1", "s", {"unknown unit", "", ""}},
        {"5 s @ 1", "s", {"unknown unit", "", ""}},
        {"5 lg(re 1 Pa)", "Pa", {"unknown unit", "", ""}},
        {"5 MPa 3", "Pa", {"unknown unit", "", ""}},
        {"5 3 MPa", "Pa", {"unknown unit", "", ""}},
        {"5 m99999", "m", {"unknown unit", "", ""}},
        {"5 ((m))", "m", {"unknown unit", "", ""}},
        {"5 (m", "m", {"unknown unit", "", ""}},
        {"5 m)", "m", {"unknown unit", "", ""}},
        {"5 /m", "m", {"unknown unit", "", ""}},
        {"5 m/", "m", {"unknown unit", "", ""}},
        {"20 degC", "K", {"an origin of its own", "expected a temperature", ""}},
    };
    for (size_t i = 0; i < COUNT(bad); i++) {
        double value = 17;
        fracas_err err = fracas_units_read(*state, bad[i].text, bad[i].si, &value);
        if (err != FRACAS_USAGE || value != 17)
            fail_msg("%s in %s was accepted as %g", bad[i].text, bad[i].si, value);
        for (int w = 0; w < 3; w++)
            if (!strstr(fracas_message(), bad[i].words[w] ? bad[i].words[w] : ""))
                fail_msg("%s: the message lacks \"%s\": %s", bad[i].text, bad[i].words[w],
                         fracas_message());
    }
}

static void test_numbers(void **state)
{
    double value;
    OK(fracas_number_read("-12.5e2", &value));
    assert_true(value == -1250.0);
    assert_int_equal(fracas_number_read("12 ", &value), FRACAS_USAGE);
    assert_int_equal(fracas_number_read("1e999", &value), FRACAS_USAGE);
    assert_true(fracas_number_round(0.1 + 0.2) == 0.3);
    assert_true(fracas_number_round(1.0 / 3.0) == 0.333333333333333);
    assert_false(signbit(fracas_number_round(-0.0)));
    char text[FRACAS_NUMBER_TEXT];
    fracas_number_write(-1.7976931348623157e308, text);
    assert_string_equal(text, "-1.79769313486232e+308");
}

/* Rounding is idempotent and text is exact: what is written reads back to the same double. A fixed
 * linear congruence walks over mantissas and exponents. */
static void test_round_trip(void **state)
{
    uint64_t x = 20261121;
    for (int i = 0; i < 5000; i++) {
        x = x * 6364136223846793005u + 1442695040888963407u;
        double value = ldexp((double)(x >> 11), (int)(x % 600) - 350), back;
        double rounded = fracas_number_round(value);
        char text[FRACAS_NUMBER_TEXT];
        fracas_number_write(rounded, text);
        OK(fracas_number_read(text, &back));
        assert_true(back == rounded && fracas_number_round(rounded) == rounded);
    }
}

TESTS_ALL(load, unload, test_values, test_locale, test_refused, test_numbers, test_round_trip)
