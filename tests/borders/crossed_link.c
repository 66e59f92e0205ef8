// A program that reaches past the pipeline's public headers. It must not link (check_link.sh).
extern const void *dip_kernels(int isa);

int main(void) {
    return dip_kernels(0) != 0;
}
