#include "renderer/base/trig.h"
#include <math.h>
double dip_sin(double x){return sin(x);}
double dip_cos(double x){return cos(x);}
