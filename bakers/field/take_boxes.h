// Boxes of a volume that are made on many threads and taken one by one, each in a slot of memory.
#pragma once

#include <cstddef>
#include <vector>

#include "bakers/field/level.h"
#include "bakers/math/parallel.h"

namespace skybake {

// Calls make(i, slot) and take(i, slot) as ordered_pipeline does.
template <class Slot, class Make, class Take>
void take_boxes(int count, int threads, int slots, const Make& make, const Take& take) {
    std::vector<Slot> memory(static_cast<std::size_t>(slots));
    const auto at = [&](int slot) -> Slot& { return memory[static_cast<std::size_t>(slot)]; };
    ordered_pipeline(
        count, threads, slots, [&](int i, int slot) { make(i, at(slot)); },
        [&](int i, int slot) { return take(i, at(slot)); });
}

// The same for boxes that are written to a file. Returns false after an interruption.
template <class Slot, class Make, class Take>
bool write_boxes(int count, int threads, Progress* progress, const Make& make, const Take& take) {
    bool complete = true;
    take_boxes<Slot>(
        count, threads, box_slots(threads),
        [&](int i, Slot& slot) {
            if (!is_cancelled(progress)) make(i, slot);
        },
        [&](int i, Slot& slot) {
            complete = !is_cancelled(progress);
            if (!complete) return false;
            const bool goes_on = take(i, slot);
            if (progress != nullptr) progress->advance("write", (i + 1.0) / count);
            return goes_on;
        });
    return complete;
}

}  // namespace skybake
