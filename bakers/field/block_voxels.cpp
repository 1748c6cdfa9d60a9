#include "bakers/field/block_voxels.h"

#include <algorithm>
#include <cstdint>
#include <cstring>
#include <utility>

#include "bakers/field/baked.h"
#include "bakers/field/bc4.h"
#include "bakers/field/bc6h.h"
#include "bakers/field/pixel_type.h"
#include "config/text/mapped.h"

namespace skybake {

namespace {

constexpr int block_edge = 4;

// Returns the blocks that contain a box, cut off at the edge of the volume.
VoxelBox whole_blocks(const VoxelBox& box, const std::array<int, 3>& size) {
    VoxelBox whole = box;
    for (std::size_t a = 0; a < 2; ++a) {
        const int end = box.origin[a] + box.size[a];
        whole.origin[a] = box.origin[a] / block_edge * block_edge;
        whole.size[a] =
            std::min(size[a], (end + block_edge - 1) / block_edge * block_edge) - whole.origin[a];
    }
    return whole;
}

// The voxels of a box, channel after channel.
struct Planes {
    VoxelBox box;
    std::vector<float> values;

    Planes(const VoxelSource& voxels, const VoxelBox& of, const std::vector<bool>& wanted)
        : box(of), values(static_cast<std::size_t>(of.count()) * wanted.size()) {
        std::vector<float*> channels;
        for (std::size_t c = 0; c < wanted.size(); ++c) {
            channels.push_back(wanted[c] ? plane(c) : nullptr);
        }
        voxels.fill(box, channels);
    }
    float* plane(std::size_t channel) {
        return values.data() + channel * static_cast<std::size_t>(box.count());
    }
    // Row y of slice z of the box.
    float* row(std::size_t channel, int y, int z) {
        return plane(channel) +
               (std::int64_t{z} * box.size[1] + y) * static_cast<std::int64_t>(box.size[0]);
    }
};

// The texels of a channel, slices below each other, with whole blocks: what lies beyond the volume
// repeats its last voxels. Values that the type cannot hold are 0.
class PaddedPlane {
  public:
    PaddedPlane(Planes& planes, std::size_t channel, PixelType type) {
        const auto whole = [](int texels) {
            return static_cast<std::size_t>((texels + block_edge - 1) / block_edge);
        };
        const auto width = static_cast<std::size_t>(planes.box.size[0]);
        plane_.blocks_x = whole(planes.box.size[0]);
        plane_.pitch = plane_.blocks_x * block_edge;
        const std::size_t block_rows = whole(planes.box.size[1]);
        plane_.blocks_y = block_rows * static_cast<std::size_t>(planes.box.size[2]);
        texels_.resize(plane_.blocks_y * block_edge * plane_.pitch + bc4_padding);
        const PixelRange range = range_of(type);
        float* to = texels_.data();
        for (int z = 0; z < planes.box.size[2]; ++z) {
            for (int y = 0; y < static_cast<int>(block_rows) * block_edge; ++y) {
                const float* row = planes.row(channel, std::min(y, planes.box.size[1] - 1), z);
                for (std::size_t i = 0; i < width; ++i) to[i] = range.contains(row[i]) ? row[i] : 0;
                std::fill(to + width, to + plane_.pitch, to[width - 1]);
                to += plane_.pitch;
            }
        }
        plane_.texels = texels_.data();
    }
    const TexelPlane& texels() const { return plane_; }
    std::size_t blocks() const { return plane_.blocks_x * plane_.blocks_y; }

  private:
    std::vector<float> texels_;
    TexelPlane plane_;
};

std::string code_planes(Planes& planes, PixelType type, std::size_t channels) {
    std::vector<PaddedPlane> padded;
    for (std::size_t c = 0; c < channels; ++c) padded.emplace_back(planes, c, type);
    std::string blocks(padded.front().blocks() * bytes_per_block(type), '\0');
    auto* out = reinterpret_cast<std::uint8_t*>(blocks.data());
    if (type == PixelType::bc6h) {
        encode_bc6h({padded[0].texels(), padded[1].texels(), padded[2].texels()}, out);
        return blocks;
    }
    for (std::size_t c = 0; c < channels; ++c) {
        encode_bc4(padded[c].texels(), out + c * bc4_bytes, bytes_per_block(type));
    }
    return blocks;
}

class DecodedVoxels : public VoxelSource {
  public:
    DecodedVoxels(std::shared_ptr<const VoxelSource> voxels, const std::array<int, 3>& size,
                  PixelType type, std::size_t channels)
        : voxels_(std::move(voxels)), size_(size), type_(type), channels_(channels) {}

    void fill(const VoxelBox& box, const std::vector<float*>& channels) const override {
        const auto wanted = mapped<bool>(channels, [&](const float* channel) {
            return channel != nullptr || type_ == PixelType::bc6h || type_ == PixelType::bc5;
        });
        Planes planes(*voxels_, whole_blocks(box, size_), wanted);
        decode_blocks(planes);
        for (std::size_t c = 0; c < channels.size(); ++c) {
            if (channels[c] != nullptr) cut_out(planes, c, box, channels[c]);
        }
    }

    // Zeros stay zeros.
    bool is_empty(const VoxelBox& box) const override {
        return voxels_->is_empty(whole_blocks(box, size_));
    }

  private:
    static void cut_out(Planes& planes, std::size_t channel, const VoxelBox& box, float* to) {
        for (int z = 0; z < box.size[2]; ++z) {
            for (int y = 0; y < box.size[1]; ++y, to += box.size[0]) {
                const float* row = planes.row(channel, box.origin[1] - planes.box.origin[1] + y,
                                              box.origin[2] - planes.box.origin[2] + z);
                std::memcpy(to, row + (box.origin[0] - planes.box.origin[0]),
                            static_cast<std::size_t>(box.size[0]) * sizeof(float));
            }
        }
    }

    void decode_blocks(Planes& planes) const {
        const std::string blocks = code_planes(planes, type_, channels_);
        const auto* block = reinterpret_cast<const std::uint8_t*>(blocks.data());
        for (int z = 0; z < planes.box.size[2]; ++z) {
            for (int y = 0; y < planes.box.size[1]; y += block_edge) {
                for (int x = 0; x < planes.box.size[0]; x += block_edge) {
                    for (std::size_t c = 0; c < channels_; ++c) put(block, planes, c, {x, y, z});
                    block += bytes_per_block(type_);
                }
            }
        }
    }

    void put(const std::uint8_t* block, Planes& planes, std::size_t channel,
             const std::array<int, 3>& at) const {
        const std::array<float, 16> texels = type_ == PixelType::bc6h
                                                 ? decode_bc6h(block)[channel]
                                                 : decode_bc4(block + channel * bc4_bytes);
        for (int j = 0; j < std::min(block_edge, planes.box.size[1] - at[1]); ++j) {
            float* row = planes.row(channel, at[1] + j, at[2]) + at[0];
            for (int i = 0; i < std::min(block_edge, planes.box.size[0] - at[0]); ++i) {
                replace(texels[static_cast<std::size_t>(block_edge * j + i)], row[i]);
            }
        }
    }

    void replace(float decoded, float& value) const {
        if (range_of(type_).contains(value)) value = decoded;
    }

    std::shared_ptr<const VoxelSource> voxels_;
    std::array<int, 3> size_;
    PixelType type_;
    std::size_t channels_;
};

}  // namespace

std::string coded_blocks(const VoxelSource& voxels, const std::array<int, 3>& size, PixelType type,
                         std::size_t channels, const VoxelBox& box) {
    Planes planes(voxels, whole_blocks(box, size), std::vector<bool>(channels, true));
    return code_planes(planes, type, channels);
}

std::shared_ptr<const VoxelSource> decoded_voxels(std::shared_ptr<const VoxelSource> voxels,
                                                  const std::array<int, 3>& size, PixelType type,
                                                  std::size_t channels) {
    return std::make_shared<DecodedVoxels>(std::move(voxels), size, type, channels);
}

void code_levels(Baked& volume) {
    if (!config::is_block_coded(volume.pixel_type)) return;
    for (Level& level : volume.levels) {
        if (level.uncoded != nullptr) continue;
        level.uncoded = level.voxels;
        level.voxels = decoded_voxels(level.uncoded, level.size, volume.pixel_type,
                                      volume.channel_names.size());
    }
}

}  // namespace skybake
