/* The exponential distribution, same bits on every CPU. */
#ifndef FRACAS_SAMPLER_EXPONENTIAL_H
#define FRACAS_SAMPLER_EXPONENTIAL_H

/* -ln(1 - u), 0 < u < 1, accurate in both tails. */
double fracas_exponential_quantile(double u);

#endif
