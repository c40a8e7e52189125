// What is selected.
import { words } from "../words";

export const Inspector = () => <p class="empty">{words.comingInspector}</p>;
