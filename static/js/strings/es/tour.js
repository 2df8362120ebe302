// Textos: la visita guiada al artículo. Los números hallados salen del núcleo, que habla inglés: `evidence` los traduce.

/** Lo que el núcleo dice en sus hallazgos, en orden: lo largo antes que lo corto. */
const PHRASES = [
  ["second half / first half", "segunda mitad / primera mitad"],
  ["largest / smallest", "mayor / menor"],
  ["settling time of ė in s", "tiempo de asentamiento de ė en s"],
  ["last sixth / whole run", "último sexto / simulación entera"],
  ["peak |z| in °", "pico de |z| en °"],
  ["settled estimates of 18", "estimados asentados de 18"],
  ["nearest of the three", "el más cercano de los tres"],
  ["within 10 %", "a menos de un 10 %"],
  ["smallest in", "el menor en"],
  [" of 6", " de 6"],
  ["I(e) in °", "I(e) en °"],
  ["I(ė) in °/s", "I(ė) en °/s"],
  ["diverged", "divergieron"],
  ["samples; verdicts need at least", "muestras; un veredicto necesita al menos"],
  ["never", "nunca"],
  ["Proposed", "Propuesto"],
  ["proposed", "propuesto"],
  ["Tang and Arteaga", "Tang y Arteaga"],
  ["Slotine and Li", "Slotine y Li"],
];

export const tour = {
  start: "Visita al artículo",
  close: "Cerrar la visita",
  back: "Atrás",
  next: "Siguiente",
  finish: "Terminar",
  progress: (number, count) => `${number} de ${count}`,
  computing: "calculando…",
  unfinished: "Falta el resultado de una simulación, así que nada se puede juzgar.",
  over: "Simulados:",
  seconds: (duration) => `${duration} s`,
  restore: "Volver a mis ajustes",
  restoreOffer: "La visita ha cambiado tus ajustes.",
  restoreFailed: (message) => `No se pudo volver a tus ajustes: ${message}`,
  verdicts: { holds: "✓ Se cumple aquí", does_not_hold: "✗ No se cumple aquí", not_tested: "– Sin comprobar" },
  found: (evidence) => `Hallado: ${evidence}.`,
  criterion: (text) => `Nuestro criterio, pues el artículo no da ninguno: ${text}.`,
  evidence: (text) => PHRASES.reduce((said, [english, spanish]) => said.replaceAll(english, spanish), text),
  sum: (holding, count) => `${holding} de ${count} afirmaciones se cumplen en las simulaciones que se muestran ahora.`,
  steps: {
    arm: {
      title: "El brazo",
      text: [
        "El CRS A465 tiene seis articulaciones; el artículo mueve las tres primeras: cintura, hombro y codo. El brazo verdadero tiene 18 parámetros: inercias, fricción viscosa y seca, gravedad.",
        "La simulación los conoce. Los controladores no: cada uno empieza con sus 18 estimados en cero.",
      ],
    },
    task: {
      title: "La tarea",
      text: [
        "Cada articulación debe seguir una suma de tres senos con un periodo de 2π segundos. El brazo empieza en la trayectoria con la velocidad deseada: una elección hecha aquí, pues el artículo no lo dice.",
        "El error de seguimiento e es dónde está una articulación menos dónde debería estar. El índice I(e), la media cuadrática sobre 3000 muestras, resume toda una simulación en un número por articulación.",
      ],
    },
    schemes: {
      title: "Los tres controladores",
      text: [
        "Slotine y Li (1987) aprenden solo del error de seguimiento. Tang y Arteaga (1994) recuerdan además cuánto erraron sus predicciones de par. Ambos necesitan las velocidades articulares.",
        "La propuesta del artículo prescinde de ellas: un observador deduce las velocidades de las posiciones. La «i» de cada tarjeta muestra las ecuaciones.",
        "Ahora, las doce afirmaciones del artículo. Cada paso pone las ganancias del artículo, señala dónde se ve la afirmación y deja que el núcleo la juzgue.",
      ],
    },
    ultimately_bounded: { title: "Los errores quedan acotados" },
    slotine_li_converges: { title: "Slotine y Li convergen" },
    errors_look_alike: { title: "Los errores se parecen" },
    slotine_li_worst: { title: "Slotine y Li siguen peor" },
    similar_to_tang_arteaga: { title: "Tan bueno como con sensor" },
    slotine_li_settles_last: { title: "Slotine y Li se asientan los últimos" },
    third_joint_velocity_stays: { title: "El error de velocidad de la tercera queda" },
    observer_replaces_the_sensor: { title: "El observador sustituye al sensor" },
    observer_peaks: { title: "Los picos del observador" },
    estimates_become_constant: { title: "Los estimados se vuelven constantes" },
    closest_estimates: { title: "Los estimados se acercan" },
    proposed_best: { title: "El esquema propuesto va por delante" },
    now: {
      title: "¿Y ahora?",
      text: [
        "Mueve ganancias: pon λ del esquema propuesto a 0 y mira cómo la mayoría de los estimados halla la verdad; divide K_v entre diez; haz que el brazo empiece parado. La «i» junto a cada ganancia dice qué esperar y deja probarlo.",
        "Marcado en la página: por qué la peor articulación es la peor, respondido para lo que pongas.",
      ],
    },
  },
  claims: {
    ultimately_bounded: {
      claim: "Los errores de seguimiento y del observador del esquema propuesto quedan finalmente acotados.",
      criterion: "en cada articulación el índice de e y el de z en la segunda mitad no superan los de la primera",
      why: "Se cumple en 12 s y en 600 s. Una simulación es un ejemplo y no una prueba, y el artículo no imprime la suya.",
    },
    slotine_li_converges: {
      claim: "Los errores de seguimiento de Slotine y Li tienden a cero.",
      criterion: "en cada articulación I(e) en la segunda mitad es menor que en la primera",
      why: "12 s son menos de dos periodos de la trayectoria: las dos mitades recorren partes distintas, y los estimados aún están en camino. En 600 s los errores bajan en todas las articulaciones.",
    },
    errors_look_alike: {
      claim: "Los errores articulares de los tres controladores se comportan de modo muy parecido.",
      criterion: "en cada articulación el mayor I(e) no pasa del doble del menor",
      why: "Las formas se parecen, pues el mismo movimiento necesita el mismo par. Los tamaños siguen a la rigidez K Λ de la realimentación, que entre esquemas difiere en un factor de 9 a 12, y así los errores: de 8 a 10.",
    },
    slotine_li_worst: {
      claim: "El controlador de Slotine y Li es el que peor sigue de los tres.",
      criterion: "su I(e) es el mayor en cada articulación (la tabla 1 del propio artículo lo niega para la 2)",
      why: "Su realimentación K Λ es la más blanda de los tres en cada articulación. La tabla 1 del artículo dice otra cosa de la articulación 2, donde pone a Slotine y Li como los mejores.",
    },
    similar_to_tang_arteaga: {
      claim: "El esquema propuesto rinde como el de Tang y Arteaga, aunque le falta el sensor de velocidad.",
      criterion: "I(e) e I(ė) de ambos difieren a lo más en un factor de 2 en cada articulación",
      why: "En 12 s es la articulación 1 la que difiere, donde la realimentación K Λ de Tang y Arteaga es casi cinco veces más rígida. En 600 s los seis cocientes quedan dentro de un factor de 2.",
    },
    slotine_li_settles_last: {
      claim: "Los errores de velocidad del controlador de Slotine y Li son los últimos en asentarse.",
      criterion: "en cada articulación su ė entra para siempre en la banda de 0.5 °/s más tarde que con los otros dos",
      why: "Con la realimentación más blanda sus errores de velocidad no quedan en la banda durante 12 s. También en 600 s se asienta el último.",
    },
    third_joint_velocity_stays: {
      claim: "Con el controlador de Slotine y Li el error de velocidad de la tercera articulación queda en un nivel acotado en vez de desaparecer.",
      criterion: "su I(ė3) en el último sexto es más de la mitad del de toda la simulación, y una parte mayor que con los otros dos",
      why: "En 12 s parece un nivel que queda. Es aprendizaje lento: en 600 s el último sexto tiene un cuarto del índice de toda la simulación, y la afirmación falla.",
    },
    observer_replaces_the_sensor: {
      claim: "Los errores de velocidad confirman que el observador hace bien las veces de un sensor.",
      criterion: "en cada articulación I(ė) del esquema propuesto es a lo más el doble del de Tang y Arteaga y menor que el de Slotine y Li",
      why: "En 12 s solo la articulación 1 lo estropea, otra vez donde la realimentación de Tang y Arteaga es mucho más rígida. En 600 s se cumple.",
    },
    observer_peaks: {
      claim: "Los errores del observador quedan bajo 0.023°, 0.027° y 0.019°.",
      criterion: "los picos no pasan de estas cotas tal como están redondeadas (K_d se calibró con ellas: no prueba nada)",
      why: "No prueba nada: el artículo no da la ganancia K_d del observador, y la usada aquí se eligió para que salgan justo estos picos.",
    },
    estimates_become_constant: {
      claim: "Solo con Tang y Arteaga y con el esquema propuesto se asientan los estimados en constantes.",
      criterion: "en el último sexto al menos 16 de 18 estimados se mueven menos del 5 % de su recorrido con estos dos, y menos con Slotine y Li",
      why: "12 s son pocos para cualquier esquema: casi todos los estimados se mueven aún. A los 600 s se han asentado 14 del esquema propuesto, 6 de Tang y Arteaga y 11 de Slotine y Li.",
    },
    closest_estimates: {
      claim: "Solo los estimados del esquema propuesto se acercan a algunos valores verdaderos.",
      criterion: "al final al menos uno de sus estimados está a menos de un 10 % de la verdad, y ninguno de los otros esquemas",
      why: "A los 12 s ningún estimado de ningún esquema está a menos de un 10 %. A los 600 s lo están cinco del propuesto, pero también uno de Tang y Arteaga y cinco de Slotine y Li.",
    },
    proposed_best: {
      claim: "Los índices de desempeño muestran al esquema propuesto por delante.",
      criterion: "tiene el menor índice en más de la mitad de las seis entradas de las tablas 1 y 2 (en las del propio artículo: 4 de 6)",
      why: "La realimentación más rígida gana más que el mejor aprendizaje: la de Tang y Arteaga es más rígida en las articulaciones 1 y 3, la propuesta en la 2. En 600 s va por delante en tres entradas de seis, que no son más de la mitad.",
    },
  },
};
