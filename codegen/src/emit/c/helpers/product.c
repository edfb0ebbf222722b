// `x * y` of square matrices, row by row.
static void robot_product(int count, const double *x, const double *y, double *product) {
    for (int i = 0; i < count; ++i) {
        for (int j = 0; j < count; ++j) {
            double sum = 0.0;
            for (int k = 0; k < count; ++k) {
                sum += x[i * count + k] * y[k * count + j];
            }
            product[i * count + j] = sum;
        }
    }
}
