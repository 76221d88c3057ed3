#include "sampler/exponential.h"

#include "base/elementary.h"

/* (sampling.10) `lost` is what the rounding of 1 - u loses, nothing for the u of a stream. */
double fracas_exponential_quantile(double u)
{
    double rest = 1.0 - u;
    double lost = (1.0 - rest) - u;
    return -(fracas_log(rest) + lost / rest);
}
