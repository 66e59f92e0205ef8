// A program that calls a private function of the pipeline. It must not link (see check_link.sh).
extern const void *dip_kernels(int isa);

int main(void) {
    return dip_kernels(0) != 0;
}
