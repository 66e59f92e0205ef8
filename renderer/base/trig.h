#ifndef T
#define T
double dip_sin(double);double dip_cos(double);
#endif
