// SPDX-License-Identifier: Apache-2.0
// The services of MR and MW that the simulated control does itself: see control.h. NCT manual 6.18 to 6.25.
#include <algorithm>

#include "control.h"

namespace rung::nct {
namespace {

constexpr Code kFirstIdentifier = 10, kPlcAddress = 11, kIdentifiers = 12, kNoProgram = 40, kNoChannel = 41,
               kNoFile = 45, kChannelRuns = 46, kWindowChannel = 6, kNoWindow = 70, kDisplay = 71, kDriveAddress = 80,
               kDriveData = 81;

constexpr uint32_t kWindows[] = {
#define NC_WINDOW(number) number,
#include "windows.def"
#undef NC_WINDOW
};

// MR10 and MW11: first identifier, PLC address, count.
Code checkNonvolatile(const Block& block) {
  if (block.amount() != 3) return kWrongAmount;
  const uint32_t first = block.word(2), address = block.word(3), count = block.word(4);
  if (first >= RUNG_NC_NONVOLATILE_WORDS) return kFirstIdentifier;
  if (count < 1 || count > RUNG_NC_NONVOLATILE_WORDS - first) return kIdentifiers;
  return address < kFirstKept || address > RUNG_NC_WORDS - count ? kPlcAddress : kDone;
}

}  // namespace

uint32_t checksumOf(const uint32_t* words);

// The services that are due are done in the order in which they came.
bool Control::poll(uint32_t number, uint32_t* memory) {
  for (Request& request : requests_)
    if (request.code == kBusy && request.due <= clock_.cycles) request.code = serve(request, memory);
  const auto at = std::find_if(requests_.begin(), requests_.end(),
                               [&](const Request& request) { return request.number == number; });
  if (at == requests_.end()) return true;
  if (at->code == kBusy) return false;
  for (uint32_t k = 1; k < at->block.size(); ++k)
    if (at->block.isWritten(k)) memory[at->address + k] = at->block.word(k);
  memory[at->address] = static_cast<uint32_t>(at->code);
  requests_.erase(at);
  return true;
}

Code Control::serve(Request& request, uint32_t* memory) {
  return request.is_write ? serveWrite(request, memory) : serveRead(request, memory);
}

Code Control::serveRead(Request& request, uint32_t* memory) {
  Block& block = request.block;
  switch (request.function) {
    case 10: return readNonvolatile(block, memory);
    case 31: return parameters_.readWords(block);
    case 32: return parameters_.readReals(block);
    case 62: return network_.receive(block, memory);
    case 101: return tools_.findEmptyPot(block);
    case 104: return tools_.readTool(block);
    case 107: return tools_.readItem(block);
    case 108: return tools_.findByUserData(block);
    case 201: return mailbox_.read(block, memory, clock_.cycles - request.due);
    case 304: return pallets_.readPallet(block);
    case 307: return pallets_.readItem(block);
    case 308: return pallets_.findPallet(block);
    case 309: return pallets_.readColumn(block);
    default: return kUnknownFunction;
  }
}

Code Control::serveWrite(Request& request, const uint32_t* memory) {
  Block& block = request.block;
  switch (request.function) {
    case 11: return writeNonvolatile(block, memory);
    case 34: return parameters_.writeWords(block);
    case 35: return parameters_.writeReals(block);
    case 40: return assignProgram(block);
    case 41: return assignPalletProgram(block);
    case 60: return network_.open(block, request.number, clock_.cycles - request.due);
    case 61: return network_.close(block);
    case 63: return network_.send(block, memory);
    case 70: return openWindow(block);
    case 81: return dumpDrive(block);
    case 90: return axes_.writePosition(block);
    case 100: return tools_.exchangePots(block);
    case 102: return tools_.registerTool(block);
    case 103: return tools_.writeTool(block);
    case 105: return tools_.deleteTool(block);
    case 106: return tools_.writeItem(block);
    case 202: return mailbox_.write(block, memory, clock_.cycles - request.due);
    case 300: return pallets_.exchangePlaces(block);
    case 303: return pallets_.writePallet(block);
    case 306: return pallets_.writeItem(block);
    default: return kUnknownFunction;
  }
}

Code Control::readNonvolatile(const Block& block, uint32_t* memory) const {
  if (const Code code = checkNonvolatile(block); code != kDone) return code;
  if (checksumOf(nonvolatile_) != nonvolatile_[RUNG_NC_NONVOLATILE_WORDS]) return kWrongChecksum;
  std::copy_n(nonvolatile_ + block.word(2), block.word(4), memory + block.word(3));
  return kDone;
}

Code Control::writeNonvolatile(const Block& block, const uint32_t* memory) {
  if (const Code code = checkNonvolatile(block); code != kDone) return code;
  std::copy_n(memory + block.word(3), block.word(4), nonvolatile_ + block.word(2));
  nonvolatile_[RUNG_NC_NONVOLATILE_WORDS] = checksumOf(nonvolatile_);
  return kDone;
}

// MW40: not while a program runs in automatic mode.
Code Control::assignProgram(Block& block) {
  if (block.amount() != 2) return kWrongAmount;
  const uint32_t number = block.word(2), channel = block.word(3) - 1;
  if (channel >= kChannels) return kNoChannel;
  if (channels_.mode(channel) == Mode::Automatic && channels_.runs(channel)) return kBusy;
  if (programs_.count(number) == 0) return kNoProgram;
  assigned_[channel] = number;
  block.put(3, 0);
  return kDone;
}

// MW41: not while a program runs, waits or is interrupted.
Code Control::assignPalletProgram(const Block& block) {
  if (block.amount() != 2) return kWrongAmount;
  const uint32_t channel = block.word(3) - 1;
  if (channel >= kChannels) return kNoChannel;
  if (channels_.runs(channel) || channels_.isStopped(channel) || channels_.isInterrupted(channel)) return kChannelRuns;
  uint32_t program = 0;
  if (const Code code = pallets_.nextProgram(block.word(2), program); code != kDone) return code;
  if (programs_.count(program) == 0) return kNoFile;
  assigned_[channel] = program;
  return kDone;
}

// MW70; both parameters may be left out.
Code Control::openWindow(const Block& block) {
  if (block.amount() < 2 || block.amount() > 4) return kWrongAmount;
  if (block.word(3) > kChannels) return kWindowChannel;
  if (std::find(std::begin(kWindows), std::end(kWindows), block.word(2)) == std::end(kWindows)) return kNoWindow;
  if (!display_ready_) return kDisplay;
  window_ = block.word(2);
  return kDone;
}

// MW81: what a drive of another maker shows.
Code Control::dumpDrive(const Block& block) {
  if (block.amount() != 3) return kWrongAmount;
  const uint32_t drive = block.word(2) - 1, type = block.word(3);
  if (drive >= kDrives) return kDriveAddress;
  if (type > 5) return kDriveData;
  const double value = block.integer(4);
  drives_.values[drive][type] = type == 1 ? value / 100 : value;  // 10 mA
  return kDone;
}

}  // namespace rung::nct
