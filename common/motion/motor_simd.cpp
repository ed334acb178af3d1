#include "common/motion/motor.h"
namespace aquarama {
void MotorStep::run() const {
    runReference();
}
}  // namespace aquarama
