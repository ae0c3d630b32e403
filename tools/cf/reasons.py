"""reasons.py - the app's reason bits as words (include/flight/guard.h, include/flight/flyable.h)."""

GUARD = (
    "a sensor or the estimate is no number",
    "the gyro is frozen",
    "the accelerometer is frozen",
    "the accelerometer is clipped",
    "the accelerometer contradicts the velocity",
    "tilted beyond 60 degrees",
    "the range sensor is lost",
    "the range sensor is frozen",
    "odd range samples",
    "below the range sensor's floor for longer than ceil.blindMax",
    "full thrust near the ceiling",
    "a set point that is no number",
    "the ceiling is nearer than the set point allows",
    "the height estimate jumped",
    "milliseconds were missed",
    "no room to take off",
    "the estimated velocity jumps",
    "the thrust carries more than it should so far from a ceiling",
    "resets of the estimated height sum up to more than a metre",
)
FLYABLE = (
    "at rest the accelerometer does not point up",
    "gyro and accelerometer contradict each other along x",
    "gyro and accelerometer contradict each other along y",
)
DECKS = ("flow deck v2", "multiranger deck")
ACTIONS = ("fly", "hold", "retreat", "hand over")
RETREAT = 2  # this action and those above are not the pilot's flight any more


def words(bits: int, names: tuple[str, ...]) -> str:
    """The names of the bits that are set; a bit without a name as a number."""
    said = [name for i, name in enumerate(names) if bits >> i & 1]
    rest = bits >> len(names) << len(names)
    return ", ".join(said + ([f"0x{rest:x}"] if rest else [])) or "none"
