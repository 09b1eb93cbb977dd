"""Makes bounce_sound.wav: the sound of a ball that falls from 20 cm and bounces on a plate.

    python3 validation/data/bounce_sound.py bounce_sound.wav

The ball has e = 0.85 - 0.02 v/(m/s) in vacuum. Each bounce is a tone of 2.3 kHz that decays in 2 ms, as loud as the ball is fast, with an
echo of a quarter of that after 9 ms; there are hum and noise. The file has 11025 samples of 8 bits per second.
"""

import math
import random
import sys
import wave

RATE, TONE, DECAY, ECHO, NOISE, HUM, LOUDNESS = 11025, 2300.0, 2e-3, (9e-3, 0.25), 0.002, 0.02, 0.4
GRAVITY, HEIGHT, N_BOUNCES = 9.80665, 0.2, 9


def main() -> None:
    """Writes the file."""
    noise = random.Random(2)
    speed = math.sqrt(2 * GRAVITY * HEIGHT)
    time, bounces = speed / GRAVITY, []
    for _ in range(N_BOUNCES):
        bounces.append((time, speed))
        speed *= 0.85 - 0.02 * speed
        time += 2 * speed / GRAVITY
    n = int((bounces[-1][0] + 0.15) * RATE)
    values = [NOISE * noise.gauss(0, 1) + HUM * math.sin(2 * math.pi * 50 * k / RATE) for k in range(n)]
    for time, speed in bounces:
        for delay, size in ((0.0, 1.0), ECHO):
            for k in range(math.ceil((time + delay) * RATE), n):
                late = k / RATE - time - delay
                values[k] += LOUDNESS * size * speed * math.exp(-late / DECAY) * math.sin(2 * math.pi * TONE * late)
    with wave.open(sys.argv[1], "wb") as file:
        file.setparams((1, 1, RATE, 0, "NONE", ""))
        file.writeframes(bytes(min(max(round(128 + 127 * value), 0), 255) for value in values))


main()
