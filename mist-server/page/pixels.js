// From linear sRGB to the bytes of a screen.

/** IEC 61966-2-1: a linear value as a byte, clipped. */
export function encoded(linear) {
  const value = Math.min(1, Math.max(0, linear));
  const curve = value <= 0.0031308 ? 12.92 * value : 1.055 * value ** (1 / 2.4) - 0.055;
  return Math.round(255 * curve);
}
