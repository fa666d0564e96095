// Which operations turn the turtle by an angle.
#pragma once

#include "compiler/bytecode.h"

namespace lsys {

[[nodiscard]] constexpr bool turns(TurtleOperation operation) {
    switch (operation) {
    case TurtleOperation::YawRight:
    case TurtleOperation::YawLeft:
    case TurtleOperation::PitchDown:
    case TurtleOperation::PitchUp:
    case TurtleOperation::RollRight:
    case TurtleOperation::RollLeft:
        return true;
    default:
        return false;
    }
}

} // namespace lsys
