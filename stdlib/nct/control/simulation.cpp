// SPDX-License-Identifier: Apache-2.0
// NCT_SIMULATE sets up the simulated control here, by subject: see simulation.h.
#include "simulation.h"

#include <algorithm>

#include "control.h"

namespace rung::nct {
namespace {

Simulation outcomeOf(bool is_done) { return is_done ? Simulation::Done : Simulation::Refused; }

}  // namespace

bool Control::simulate(int32_t what, const Settings& settings, double& result) {
  result = 0;
  for (const auto group : {&Control::simulateControl, &Control::simulateMachine, &Control::simulateChannel,
                           &Control::simulateTools, &Control::simulateDevices})
    if (const Simulation outcome = (this->*group)(what, settings, result); outcome != Simulation::Elsewhere)
      return outcome == Simulation::Done;
  return false;  // the program gave another number
}

// Sets up the operator, files and settings.
Simulation Control::simulateControl(int32_t what, const Settings& settings, double& result) {
  switch (what) {
    case Simulated::Parameter:
      return outcomeOf(parameters_.write(settings.word(0), settings.word(1), settings.real(2)));
    case Simulated::ParameterRead: return outcomeOf(parameters_.read(settings.word(0), settings.word(1), result));
    case Simulated::Checksum:
      parameters_.setChecksumWrong(settings.flag(0));
      if (settings.flag(1) && nonvolatile_ != nullptr) ++nonvolatile_[RUNG_NC_NONVOLATILE_WORDS];
      return Simulation::Done;
    case Simulated::PartProgram:
      if (settings.flag(1))
        programs_.insert(settings.word(0));
      else
        programs_.erase(settings.word(0));
      return Simulation::Done;
    case Simulated::Display: display_ready_ = settings.flag(0); return Simulation::Done;
    case Simulated::Window: result = window_; return Simulation::Done;
    case Simulated::Latency: latency_ = static_cast<uint32_t>(std::max(settings.whole(0), 1)); return Simulation::Done;
    case Simulated::Cancel: messages_.cancel(); return Simulation::Done;
    case Simulated::Clear: messages_.clear(); return Simulation::Done;
    case Simulated::Screen:
      messages_.setRows(static_cast<uint32_t>(std::max(settings.whole(0), 1)));
      return Simulation::Done;
    default: return Simulation::Elsewhere;
  }
}

// Sets up axes, spindles, drives, inputs and handwheels.
Simulation Control::simulateMachine(int32_t what, const Settings& settings, double&) {
  uint32_t unit = 0;
  switch (what) {
    case Simulated::AxisPosition:
      if (!settings.unit(0, 0, kAxes, unit)) return Simulation::Refused;
      axes_.setPosition(unit, settings.real(1));
      return Simulation::Done;
    case Simulated::AxisAlarm:
      if (!settings.unit(0, 0, kAxes, unit)) return Simulation::Refused;
      axes_.setAlarm(unit, settings.flag(1));
      return Simulation::Done;
    case Simulated::SpindleAlarm:
      if (!settings.unit(0, 0, kSpindles, unit)) return Simulation::Refused;
      spindles_.setAlarm(unit, settings.flag(1));
      return Simulation::Done;
    case Simulated::DriveError:
      if (!settings.unit(0, 0, kDrives, unit)) return Simulation::Refused;
      drives_.errors[unit] = settings.bits(1);
      return Simulation::Done;
    case Simulated::MachineOff: drives_.is_forbidden = settings.flag(0); return Simulation::Done;
    case Simulated::Handwheel:
      if (!settings.unit(0, 1, 4, unit)) return Simulation::Refused;
      handwheels_[unit] += settings.whole(1);
      return Simulation::Done;
    case Simulated::Inputs:
      if (!settings.unit(0, 1, 64, unit)) return Simulation::Refused;
      inputs_[unit] = static_cast<uint8_t>(settings.whole(1));
      return Simulation::Done;
    default: return Simulation::Elsewhere;
  }
}

// Sets up channels and their programs.
Simulation Control::simulateChannel(int32_t what, const Settings& settings, double& result) {
  uint32_t unit = 0;
  switch (what) {
    case Simulated::Assigned:
      if (!settings.unit(0, 1, kChannels, unit)) return Simulation::Refused;
      result = assigned_[unit];
      return Simulation::Done;
    case Simulated::Block: {
      if (!settings.unit(0, 1, kChannels, unit)) return Simulation::Refused;
      PartBlock block;
      block.m[0] = settings.whole(1);
      block.s = settings.whole(2);
      block.t = settings.whole(3);
      block.m[1] = settings.whole(4);
      block.m[2] = settings.whole(5);
      channels_.append(unit, block);
      return Simulation::Done;
    }
    case Simulated::Macro: {
      double* const at = macro(settings.whole(0), settings.whole(1));
      if (at == nullptr) return Simulation::Refused;
      *at = settings.real(2);
      return Simulation::Done;
    }
    case Simulated::MacroRead: {
      const double* const at = macro(settings.whole(0), settings.whole(1));
      if (at == nullptr) return Simulation::Refused;
      result = *at;
      return Simulation::Done;
    }
    case Simulated::CountTarget:
      if (!settings.unit(0, 1, kChannels, unit)) return Simulation::Refused;
      channels_.setPartTarget(unit, settings.word(1));
      return Simulation::Done;
    default: return Simulation::Elsewhere;
  }
}

// Sets up the tables of tools and pallets.
Simulation Control::simulateTools(int32_t what, const Settings& settings, double& result) {
  switch (what) {
    case Simulated::Tables:
      tools_.setUse({settings.flag(0), settings.flag(1), settings.flag(2)});
      pallets_.setEdited(settings.flag(3));
      return Simulation::Done;
    case Simulated::Cartridge:
      return outcomeOf(tools_.setCartridge(settings.word(0), settings.word(1), settings.word(2), settings.word(3)));
    case Simulated::Pattern:
      return outcomeOf(tools_.setPattern(settings.word(0),
                                         {settings.word(1), settings.word(2), settings.word(3), settings.word(4)},
                                         settings.flag(5)));
    case Simulated::Pot: return outcomeOf(tools_.setPot(settings.word(0), settings.word(1), settings.word(2)));
    case Simulated::PotRead: {
      uint32_t data_number = 0;
      if (!tools_.pot(settings.word(0), settings.word(1), data_number)) return Simulation::Refused;
      result = data_number;
      return Simulation::Done;
    }
    case Simulated::ToolRead: return outcomeOf(tools_.item(settings.word(0), settings.word(1), result));
    case Simulated::ResetLife: return outcomeOf(tools_.resetLife(settings.word(0)));
    case Simulated::Tool: return outcomeOf(tools_.setItem(settings.word(0), settings.word(1), settings.real(2)));
    case Simulated::Pallets: {
      const double bits = (settings.flag(0) ? 1 : 0) + (settings.flag(1) ? 2 : 0) + (settings.flag(2) ? 8 : 0);
      return outcomeOf(parameters_.write(3300, 0, bits) && parameters_.write(3301, 0, settings.real(3)) &&
                       parameters_.write(3302, 0, settings.real(4)));
    }
    default: return Simulation::Elsewhere;
  }
}

// Sets up devices with an EtherCAT mailbox.
Simulation Control::simulateDevices(int32_t what, const Settings& settings, double&) {
  switch (what) {
    case Simulated::Device: return outcomeOf(mailbox_.setDevice(settings.word(0), settings.word(1), settings.flag(2)));
    case Simulated::DeviceError:
      return outcomeOf(mailbox_.setError(settings.word(0), settings.bits(1), settings.flag(2)));
    case Simulated::Object:
      return outcomeOf(mailbox_.setObject(settings.word(0), settings.word(1), settings.word(2),
                                          static_cast<uint64_t>(static_cast<int64_t>(settings.real(3))),
                                          settings.word(4), settings.word(5)));
    default: return Simulation::Elsewhere;
  }
}

}  // namespace rung::nct
