#include "bakers/plot/field_scaling.h"

#include <algorithm>
#include <cstddef>
#include <vector>

namespace skybake {
namespace {

Image2<float> averaged(const Image2<float>& field, int block) {
    Image2<float> small((field.width + block - 1) / block, (field.height + block - 1) / block,
                        field.channels);
    for (int y = 0; y < small.height; ++y) {
        for (int x = 0; x < small.width; ++x) {
            const int x_end = std::min((x + 1) * block, field.width);
            const int y_end = std::min((y + 1) * block, field.height);
            const int count = (x_end - x * block) * (y_end - y * block);
            for (int channel = 0; channel < field.channels; ++channel) {
                double sum = 0;
                for (int row = y * block; row < y_end; ++row) {
                    for (int column = x * block; column < x_end; ++column) {
                        sum += double{field.texel(column, row)[channel]};
                    }
                }
                small.texel(x, y)[channel] = static_cast<float>(sum / count);
            }
        }
    }
    return small;
}

Image2<float> repeated(const Image2<float>& field, int times) {
    Image2<float> large(field.width * times, field.height * times, field.channels);
    for (int y = 0; y < large.height; ++y) {
        for (int x = 0; x < large.width; ++x) {
            std::copy_n(field.texel(x / times, y / times), field.channels, large.texel(x, y));
        }
    }
    return large;
}

}  // namespace

Image2<float> fitted(const Image2<float>& field, int smallest_edge, int longest_edge) {
    const int longer = std::max(field.width, field.height);
    if (longer == 0) return field;
    if (longer > longest_edge) return averaged(field, (longer + longest_edge - 1) / longest_edge);
    if (longer < smallest_edge) return repeated(field, (smallest_edge + longer - 1) / longer);
    return field;
}

}  // namespace skybake
