// What a plan can be made of.
import { words } from "../words";

export const Palette = () => <p class="empty">{words.comingPalette}</p>;
