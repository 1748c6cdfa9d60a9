// A file as the library reads it.
#pragma once

#include <ImfIO.h>

#include <algorithm>
#include <cstdint>
#include <optional>
#include <stdexcept>
#include <string>
#include <utility>

#include "bakers/io/files/file_io.h"
#include "config/diagnostics/diagnostic.h"

namespace skybake {

class ExrStream : public Imf::IStream {
  public:
    ExrStream(const std::string& name, FileInput file)
        : Imf::IStream(name.c_str()), file_(std::move(file)) {}
    bool read(char out[], int count) override {
        const auto wanted = static_cast<std::size_t>(std::max(count, 0));
        const auto done = file_.read(position_, out, wanted);
        if (!done) {
            failed_ = true;
            throw std::runtime_error("it cannot be read");
        }
        if (*done < wanted) throw std::runtime_error("it ends early");
        position_ += wanted;
        return position_ < file_.size();
    }
    uint64_t tellg() override { return position_; }
    void seekg(uint64_t position) override { position_ = position; }
    std::uint64_t size() const { return file_.size(); }
    // Returns why the file could not be read, if the system gave a reason.
    std::optional<config::Diagnostic> failure() const {
        return failed_ ? std::optional(file_.diagnostic()) : std::nullopt;
    }

  private:
    FileInput file_;
    std::uint64_t position_ = 0;
    bool failed_ = false;
};

}  // namespace skybake
