// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <memory>
#include <vector>

#include "core/io/messages/cloud_message.h"
#include "core/io/messages/raw_message.h"
#include "core/io/packets/packet_options.h"

namespace trajlo {

struct CloudOptions {
  PacketOptions packets;
  /// Threads that decompress bz2 in a ROS 1 bag ahead (see ChunksAhead); 0: one for each core.
  int threads = 1;
};

/// True for any file (OpenClouds() tells what it is), and for a folder that is a ROS 2 bag or holds
/// ROS 1 bags; other folders are those of scans.
bool HoldsClouds(const std::filesystem::path& path);

/// True for a capture of packets. Throws InputError where the file cannot be opened.
bool HoldsPackets(const std::filesystem::path& path);

/// Opens a bag (ROS 1 .bag, ROS 2 .db3 or .mcap), a capture of packets (.pcap, .pcapng, or bare
/// payloads of a Velodyne), or a folder of bags, which are read one after the other in the natural
/// order of their names. The kind is told by the first bytes, not by the name. Throws InputError.
std::unique_ptr<CloudMessageReader> OpenClouds(const std::filesystem::path& path,
                                               const CloudOptions& options = {});

/// The ROS 1 bags that `path` names: itself, or those in the folder, in the natural order of their
/// names. Empty if it names none, or bags of ROS 2 as well.
std::vector<std::filesystem::path> Ros1BagsOf(const std::filesystem::path& path);

/// What OpenMessages() takes one after the other to read all of `path`: itself, but of a folder
/// that holds ROS 1 bags each bag of either kind, in the natural order of their names.
std::vector<std::filesystem::path> BagsOf(const std::filesystem::path& path);

/// True for what OpenMessages() opens, and for a folder of ROS 1 bags.
bool HoldsMessages(const std::filesystem::path& path);

/// Opens a ROS 1 bag, or a ROS 2 bag (a file or a folder), whatever messages are in it. `threads`
/// as in CloudOptions. Throws InputError.
std::unique_ptr<RawMessageReader> OpenMessages(const std::filesystem::path& path, int threads = 1);

}  // namespace trajlo
