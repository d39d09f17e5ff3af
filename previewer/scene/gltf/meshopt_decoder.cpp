// SPDX-License-Identifier: Apache-2.0
#include "scene/gltf/meshopt_decoder.h"

#include <meshoptimizer.h>

#include "scene/gltf/refusal.h"
#include "scene/limits.h"

namespace bounce::scene::gltf {
namespace {

bool decode(const std::string& mode, std::vector<uint8_t>& out, size_t count, size_t stride,
            std::span<const uint8_t> bytes) {
    if (mode == "ATTRIBUTES") {
        return stride % 4 == 0 &&
               meshopt_decodeVertexBuffer(out.data(), count, stride, bytes.data(), bytes.size()) == 0;
    }
    if (stride != 2 && stride != 4) {
        return false;
    }
    if (mode == "TRIANGLES") {
        return count % 3 == 0 &&
               meshopt_decodeIndexBuffer(out.data(), count, stride, bytes.data(), bytes.size()) == 0;
    }
    return mode == "INDICES" &&
           meshopt_decodeIndexSequence(out.data(), count, stride, bytes.data(), bytes.size()) == 0;
}

// Strides are the extension's: octahedral 4 or 8, quaternions 8, exponentials any multiple of 4.
bool filter(const std::string& name, std::vector<uint8_t>& out, size_t count, size_t stride) {
    if (name == "NONE") {
        return true;
    }
    if (name == "OCTAHEDRAL" && (stride == 4 || stride == 8)) {
        meshopt_decodeFilterOct(out.data(), count, stride);
        return true;
    }
    if (name == "QUATERNION" && stride == 8) {
        meshopt_decodeFilterQuat(out.data(), count, stride);
        return true;
    }
    if (name == "EXPONENTIAL" && stride % 4 == 0) {
        meshopt_decodeFilterExp(out.data(), count, stride);
        return true;
    }
    return false;
}

}  // namespace

std::vector<uint8_t> decode_meshopt(const nlohmann::json& description, std::span<const uint8_t> bytes,
                                    const std::string& whose) {
    const auto count = description["count"].get<uint64_t>();
    const auto stride = description["byteStride"].get<uint64_t>();
    const auto mode = description["mode"].get<std::string>();
    const std::string filter_name = description.value("filter", std::string("NONE"));
    // The densest stream is one of constant attributes: two bits for sixteen vertices, a byte each.
    constexpr uint64_t most_expansion = 64;
    if (count * stride > k_max_decoded_view_bytes || count * stride / most_expansion > bytes.size()) {
        throw refusal("{} would decompress to {} bytes from {}, which is not believable", whose,
                      count * stride, bytes.size());
    }
    std::vector<uint8_t> out(count * stride);
    if (!decode(mode, out, count, stride, bytes)) {
        throw refusal("{} cannot be decompressed (meshopt, mode {})", whose, mode);
    }
    if (!filter(filter_name, out, count, stride)) {
        throw refusal("{} has the unknown or unfitting meshopt filter {}", whose, filter_name);
    }
    return out;
}

}  // namespace bounce::scene::gltf
