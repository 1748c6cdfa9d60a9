// This header says how volumes are baked as frames of a loop: each frame is an asset of its own, so
// that frames can be baked apart, and the recipe has an asset for each.
//
// This header says how assets hold more wavelengths than a texture has channels: in packets, one
// after the other in the order of the recipe. All have four wavelengths but the last, which may have
// fewer. An asset holds one packet, and the recipe has an asset for each.
#pragma once

#include <cstddef>
#include <span>
#include <string>

#include "config/sections/parameters.h"

namespace skybake::config {

struct DecodedSection;
struct Decoder;

// Returns the parameters half-way between a frame and the next one: those of a loop of twice as many
// frames. Noises and clouds move in both alike.
Parameters after_frame(const Parameters& parameters, int frame);

// Returns the name of a frame of a sequence, counted from 1: NAME_0001. All frames have as many digits
// as the last one, so that names are in the order of frames; Blender takes the first to be 1, and
// Unreal the last digits of a name for the frame.
std::string frame_name(const std::string& sequence, int frame, int frames);

// Returns the name of the sequence whose first frame has this name.
std::string sequence_name(const std::string& first_frame);

// Returns a recipe's parameters at a frame: the first frame is the time that a noise or a cloud has,
// and each frame after it a frame later. Frame 0 changes nothing.
Parameters at_frame(const Parameters& parameters, int frame);

// The noise or cloud that an asset is made of, and the frames of its loop.
struct Motion {
    std::string name;  // "noise `base`"
    int period = 0;    // 0: it stands still
};

Motion motion_of(const Noise& noise);
Motion motion_of(const Cloud& cloud);

// Reports frames of a volume nothing of which moves (E0174), and warns of frames that are not whole
// loops of what moves (W0219).
void check_frames(const DecodedSection& bake, std::span<const Motion> motions, Decoder& decoder);

inline constexpr std::size_t wavelengths_per_packet = 4;

// Returns the number of packets of a recipe: 1 if a texture has a channel for each wavelength.
int packet_count(const Parameters& parameters);

// Returns the place of a packet's first wavelength among those of the recipe, and the number of
// its wavelengths.
struct PacketRange {
    std::size_t first = 0;
    std::size_t count = 0;
};
PacketRange packet_range(const Parameters& parameters, int packet);

// Returns a recipe's parameters at the wavelengths of one packet; of packet 0, all of them.
Parameters packet_of(const Parameters& parameters, int packet);

}  // namespace skybake::config
