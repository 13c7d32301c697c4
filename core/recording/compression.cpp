// SPDX-License-Identifier: BSD-3-Clause
#include "recording/compression.h"

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <memory>
#include <vector>

#include <bzlib.h>
#include <lz4frame.h>
#include <zstd.h>

namespace lvcalib {
namespace {

constexpr std::size_t kPiece = std::size_t{1} << 18;
// What a frame of zstd may ask for to look back: 128 MB, the reference decoder's own default.
constexpr int kLargestWindowLog = 27;

// A decoder takes bytes from `in`, writes to `to`, and says how many of each it used.
struct Step {
  std::size_t used = 0;
  std::size_t made = 0;
  bool end = false;  // A frame is complete.
  bool bad = false;
};

class Decoder {
 public:
  virtual ~Decoder() = default;
  virtual Step step(std::string_view in, char* to, std::size_t room) = 0;
};

class Bz2Decoder : public Decoder {
 public:
  Bz2Decoder() { ready_ = BZ2_bzDecompressInit(&stream_, 0, 0) == BZ_OK; }
  Bz2Decoder(const Bz2Decoder&) = delete;
  Bz2Decoder& operator=(const Bz2Decoder&) = delete;
  ~Bz2Decoder() override { BZ2_bzDecompressEnd(&stream_); }
  Step step(std::string_view in, char* to, std::size_t room) override {
    Step out;
    if (!ready_) return {.bad = true};
    constexpr std::size_t most = std::size_t{1} << 30;
    stream_.next_in = const_cast<char*>(in.data());  // The library does not write to it.
    stream_.avail_in = static_cast<unsigned>(std::min(in.size(), most));
    stream_.next_out = to;
    stream_.avail_out = static_cast<unsigned>(std::min(room, most));
    const unsigned in_before = stream_.avail_in;
    const unsigned out_before = stream_.avail_out;
    const int code = BZ2_bzDecompress(&stream_);
    out.used = in_before - stream_.avail_in;
    out.made = out_before - stream_.avail_out;
    out.end = code == BZ_STREAM_END;
    out.bad = code != BZ_OK && code != BZ_STREAM_END;
    return out;
  }

 private:
  bz_stream stream_{};
  bool ready_ = false;
};

class Lz4Decoder : public Decoder {
 public:
  Lz4Decoder() { LZ4F_createDecompressionContext(&context_, LZ4F_VERSION); }
  Lz4Decoder(const Lz4Decoder&) = delete;
  Lz4Decoder& operator=(const Lz4Decoder&) = delete;
  ~Lz4Decoder() override { LZ4F_freeDecompressionContext(context_); }
  Step step(std::string_view in, char* to, std::size_t room) override {
    if (context_ == nullptr) return {.bad = true};
    std::size_t used = in.size();
    std::size_t made = room;
    const std::size_t code = LZ4F_decompress(context_, to, &made, in.data(), &used, nullptr);
    if (LZ4F_isError(code) != 0U) return {.bad = true};
    return {used, made, code == 0, false};
  }

 private:
  LZ4F_dctx* context_ = nullptr;
};

class ZstdDecoder : public Decoder {
 public:
  ZstdDecoder() : context_(ZSTD_createDCtx()) {
    if (context_ != nullptr)
      ZSTD_DCtx_setParameter(context_, ZSTD_d_windowLogMax, kLargestWindowLog);
  }
  ZstdDecoder(const ZstdDecoder&) = delete;
  ZstdDecoder& operator=(const ZstdDecoder&) = delete;
  ~ZstdDecoder() override { ZSTD_freeDCtx(context_); }
  Step step(std::string_view in, char* to, std::size_t room) override {
    if (context_ == nullptr) return {.bad = true};
    ZSTD_inBuffer source{in.data(), in.size(), 0};
    ZSTD_outBuffer target{to, room, 0};
    const std::size_t code = ZSTD_decompressStream(context_, &target, &source);
    if (ZSTD_isError(code) != 0U) return {0, target.pos, false, true};
    return {source.pos, target.pos, code == 0, false};
  }

 private:
  ZSTD_DCtx* context_;
};

std::unique_ptr<Decoder> make_decoder(Compression compression) {
  switch (compression) {
    case Compression::kBz2:
      return std::make_unique<Bz2Decoder>();
    case Compression::kLz4:
      return std::make_unique<Lz4Decoder>();
    case Compression::kZstd:
      return std::make_unique<ZstdDecoder>();
    case Compression::kNone:
      break;
  }
  return nullptr;
}

struct CloseFile {
  void operator()(std::FILE* file) const { std::fclose(file); }
};
using File = std::unique_ptr<std::FILE, CloseFile>;

}  // namespace

std::optional<Compression> compression_by_name(std::string_view name) {
  if (name.empty() || name == "none") return Compression::kNone;
  if (name == "bz2") return Compression::kBz2;
  if (name == "lz4") return Compression::kLz4;
  if (name == "zstd") return Compression::kZstd;
  return std::nullopt;
}

Compression compression_by_content(std::string_view bytes) {
  if (bytes.starts_with("\x28\xb5\x2f\xfd")) return Compression::kZstd;
  if (bytes.starts_with("\x04\x22\x4d\x18")) return Compression::kLz4;
  return Compression::kNone;
}

bool decompress(Compression compression, std::string_view bytes, std::size_t limit,
                std::string& out) {
  out.clear();
  const auto decoder = make_decoder(compression);
  if (!decoder) {
    out.assign(bytes.substr(0, limit));
    return bytes.size() <= limit;
  }
  std::size_t filled = 0;
  bool complete = false;
  while (true) {
    // One byte more than allowed, so that data beyond the limit show.
    if (filled == out.size()) {
      out.resize(std::min(limit + 1, std::max({kPiece, 2 * filled, 3 * bytes.size()})));
    }
    const Step step = decoder->step(bytes, out.data() + filled, out.size() - filled);
    bytes.remove_prefix(step.used);
    filled += step.made;
    complete = step.end;
    if (step.bad || filled > limit) {
      complete = false;
      break;
    }
    if (step.end && (bytes.empty() || compression == Compression::kBz2)) break;
    if (step.used == 0 && step.made == 0) break;
  }
  out.resize(std::min(filled, limit));
  return complete;
}

Result<bool> decompress_file(const std::filesystem::path& from, const std::filesystem::path& to,
                             const RunContext& context) {
  const File in(std::fopen(from.c_str(), "rbe"));
  if (!in) return Error::input(Message("cannot be read: %1", std::strerror(errno)), from);
  const File out(std::fopen(to.c_str(), "wbe"));
  if (!out) return Error::output(Message("cannot be written: %1", std::strerror(errno)), to);
  std::vector<char> stored(kPiece);
  std::vector<char> plain(4 * kPiece);
  std::unique_ptr<Decoder> decoder;
  bool end = false;
  while (const std::size_t got = std::fread(stored.data(), 1, stored.size(), in.get())) {
    if (context.stopped()) return Error::cancelled();
    std::string_view rest(stored.data(), got);
    if (!decoder) decoder = make_decoder(compression_by_content(rest));
    if (!decoder) return Error::input(Message("is neither an lz4 nor a zstd file"), from);
    // What a decoder still holds comes out once the output was full, also without input.
    for (bool full = false; !rest.empty() || full;) {
      const Step step = decoder->step(rest, plain.data(), plain.size());
      rest.remove_prefix(step.used);
      end = step.end;
      if (std::fwrite(plain.data(), 1, step.made, out.get()) != step.made) {
        return Error::output(
            Message("cannot be written: %1", std::strerror(errno)), to,
            Message("unpack the file first, or give TMPDIR a place with more room"));
      }
      if (step.bad) return false;
      full = step.made == plain.size();
      if (step.used == 0 && step.made == 0) break;
    }
  }
  if (std::ferror(in.get()) != 0) return Error::input(Message("cannot be read to its end"), from);
  if (!decoder) return Error::input(Message("is empty"), from);
  if (std::fflush(out.get()) != 0) return Error::output(Message("cannot be written"), to);
  return end;
}

}  // namespace lvcalib
