// Textos: qué hace cada ganancia y qué muestra una simulación cuando es pequeña o grande.

const feedback =
  "Ganancia de la realimentación: cuántos newton metro responden a cada rad/s de la variable deslizante s. Con la pendiente Λ " +
  "forma un resorte y un amortiguador entre el brazo y su trayectoria deseada; lo que los estimados aún no saben sale de aquí.";
const slope =
  "Pendiente de la superficie deslizante: sobre s = 0 el error de seguimiento decae por el factor e cada 1/Λ segundos. También " +
  "fija con qué rigidez tira la realimentación, pues el par para un error fijo es K Λ e.";
const rate =
  "Ganancia de adaptación de cada parámetro, un número para cada uno de los 18: con qué rapidez se mueve su estimado cuando la " +
  "variable deslizante dice que el par era erróneo.";
const filter =
  "Ancho de banda del filtro paso bajo W(s). Filtrar el modelo en ambos lados elimina del error de predicción la aceleración " +
  "articular, que nadie mide.";
const betaSmall = "I(e) sube de un 2 a un 6 %: con el valor del artículo la memoria añade poco al gradiente.";
const betaLarge = "I(e) baja de un 18 a un 28 %, y los estimados acaban más cerca de la verdad.";
const boundSmall =
  "Con un décimo del valor nominal los estimados no pueden alcanzar la verdad: se detienen en su décima parte, e I(e) es de 1.1 " +
  "a 1.4 veces mayor.";
const boundLarge =
  "Nada cambia: con los valores del artículo ningún estimado supera 1.4 veces la verdad, así que nunca se toca la cota.";
const memorySmall = "I(e) cambia menos de un 0.1 %: con el valor del artículo la memoria apenas participa en la adaptación.";
const memoryLarge =
  "I(e) cambia menos de un 1 %. Hace falta mil veces el valor del artículo para notarlo, y entonces los pares llegan a cientos de N·m.";

export const gains = {
  proposed: {
    k_v: {
      what: feedback,
      small:
        "Todas las articulaciones siguen de 2 a 4 veces peor, pero los errores mayores enseñan más: a los 12 s los estimados " +
        "están más cerca de la verdad que con el valor del artículo.",
      large:
        "Todas siguen de 7 a 9 veces mejor, y los estimados aprenden menos, pues queda menos error del que aprender. Esta " +
        "simulación no tiene ruido de sensores; en un brazo real la ganancia también multiplica el ruido.",
    },
    lambda: {
      what: slope,
      small: "Los errores de seguimiento crecen unas diez veces. Lo que aprenden los estimados queda casi igual.",
      large: "Los errores de seguimiento bajan unas diez veces, y los picos de par suben entre un quinto y un tercio.",
    },
    lambda_z: {
      what:
        "Rapidez con que decae el error del observador z. La velocidad del controlador contiene z y su integral solo como " +
        "z + Λ_z ξ, cuyo movimiento no depende en nada de Λ_z.",
      small: "Los picos de z crecen de 3 a 4 veces. Seguimiento, pares e índices quedan como estaban.",
      large: "Los picos de z bajan a cerca de un noveno. Seguimiento, pares e índices quedan como estaban.",
    },
    lambda_x: {
      what:
        "Con qué fuerza entra el error de seguimiento en el observador. El artículo la usa sin dar su valor: aquí es igual a la Λ " +
        "del artículo, y no la sigue cuando esa se cambia.",
      small: "El seguimiento apenas cambia (menos de un 1 %), y los picos del error del observador bajan a la mitad o menos.",
      large: "La simulación diverge en una décima de segundo, también con un paso diez veces más fino: el lazo mismo es inestable.",
    },
    k_d: {
      what:
        "Ancho de banda de la velocidad observada: sigue a la verdadera como un filtro paso bajo con esta frecuencia de corte. El " +
        "artículo no da su valor; este se calibró con los picos de z del artículo, de modo que su coincidencia no prueba nada.",
      small:
        "La velocidad observada se retrasa tanto que los pares oscilan con cientos y miles de N·m; la articulación 2 se desvía " +
        "varios grados.",
      large:
        "Los picos de z bajan a cerca de un tercio; el seguimiento gana menos de un 1 %. Con diez veces el valor del artículo un " +
        "paso de 1 ms es demasiado grueso para el observador y la simulación diverge; con 0.1 ms no.",
    },
    beta: {
      what:
        "Peso del error de predicción recordado w en la adaptación. Con 0 los estimados siguen solo el gradiente. Como w es " +
        "proporcional a γ, solo cuenta el producto β γ.",
      small: betaSmall,
      large: betaLarge,
    },
    gamma: {
      what:
        "Con qué fuerza entra cada nuevo error de predicción en la memoria w y en la matriz Z. Solo cuenta su producto con β: un " +
        "cambio de γ hace exactamente lo mismo que ese cambio de β.",
      small: betaSmall,
      large: betaLarge,
    },
    forgetting: {
      what:
        "Con qué rapidez se borra la memoria de errores de predicción: el valor del artículo guarda los últimos 8 ms. Una memoria " +
        "larga es lo que sustituye a la excitación persistente, mientras los parámetros verdaderos no cambien.",
      small:
        "Sin ningún olvido la mayoría de los estimados halla la verdad en 12 s: 11 de 18 acaban a menos de un 10 % de ella, donde el valor del " +
        "artículo no lleva a ninguno. I(e) baja a la mitad.",
      large: "La memoria es demasiado corta para contar: I(e) sube de un 2 a un 6 %, como sin memoria.",
    },
    filter_rad_s: {
      what: filter,
      small: "I(e) sube a lo más un 1.5 %: con la memoria corta de la λ del artículo el filtro cuenta poco.",
      large: "I(e) cambia menos de un 0.1 %.",
    },
    rho: {
      what:
        "Fuerza de la proyección que devuelve un estimado en sus cotas. Un estimado empujado bajo cero se detiene donde ρ δ = 1, a " +
        "una profundidad igual al margen dividido por ρ.",
      small: "Con su valor mínimo, 1, el seguimiento es igual hasta tres cifras: los estimados bajan un poco más de cero.",
      large: "El seguimiento es igual hasta tres cifras. Los estimados quedan más cerca de cero.",
    },
    gamma_adapt: {
      what: rate,
      small: "Se aprende despacio: a los 12 s los estimados apenas se han movido, e I(e) es de 1.2 a 1.5 veces mayor.",
      large:
        "I(e) baja a cerca de la mitad, pero los estimados se pasan: alguno supera siete veces el valor verdadero antes de volver. " +
        "La proyección los mantiene por debajo de diez veces.",
    },
    lower_margin: {
      what:
        "Ancho de la franja bajo cero en la que la proyección crece hasta su fuerza plena. Los parámetros físicos no pueden ser " +
        "negativos; la franja es cuánto pueden serlo los estimados.",
      small: "El seguimiento es igual hasta tres cifras; una franja tan estrecha es más fina de lo que un paso de 1 ms distingue.",
      large: "El seguimiento es igual hasta tres cifras; los estimados bajan hasta −4·10⁻⁴.",
    },
    upper_factor: {
      what:
        "Cota superior de cada estimado como múltiplo del valor nominal: donde la proyección empieza a empujar. Los botones mueven " +
        "las dos cotas a la vez, pues esta debe quedar por debajo de la otra.",
      small: boundSmall,
      large: boundLarge,
    },
    upper_hard_factor: {
      what:
        "Donde acaba el margen superior y la proyección tiene su fuerza plena, como múltiplo del valor nominal. Los botones mueven " +
        "las dos cotas a la vez, pues esta debe quedar por encima de la otra.",
      small: boundSmall,
      large: boundLarge,
    },
  },
  tang_arteaga: {
    k_s: {
      what: feedback,
      small:
        "La articulación 1 sigue de 5 a 6 veces peor, la 2 de 2 a 3 veces, la 3 1.5 veces. Algunos estimados oscilan mucho más " +
        "allá de la verdad.",
      large: "Todas siguen de 6 a 10 veces mejor, y los estimados casi no aprenden: queda muy poco error del que aprender.",
    },
    lambda: {
      what: slope,
      small: "Los errores de seguimiento crecen unas diez veces.",
      large: "Los errores de seguimiento bajan unas diez veces, y el par de la articulación 2 se vuelve más áspero de muestra a muestra.",
    },
    delta: {
      what:
        "Peso del error de predicción recordado g en la adaptación. Multiplica a g sola, sin Γ_1, y solo cuenta su producto con γ_2.",
      small: memorySmall,
      large: memoryLarge,
    },
    gamma: {
      what:
        "Con qué fuerza entra cada nuevo error de predicción en la memoria g y en la matriz Z. Solo cuenta su producto con δ: un " +
        "cambio de γ_2 hace exactamente lo mismo que ese cambio de δ.",
      small: memorySmall,
      large: memoryLarge,
    },
    forgetting: {
      what:
        "Con qué rapidez se borra la memoria de errores de predicción: el valor del artículo guarda cerca de los últimos 50 ms. Z, " +
        "y con ella el tirón hacia la verdad, crece cuando esta se hace menor.",
      small: "Aun sin olvido I(e) baja solo un 5 %: el peso δ γ_2 es demasiado pequeño para que la memoria enseñe mucho en 12 s.",
      large: "I(e) cambia menos de un 0.1 %.",
    },
    filter_rad_s: {
      what: filter,
      small: "I(e) cambia menos de un 0.1 %: la memoria, lo único que usa el filtro, apenas participa en la adaptación.",
      large: "I(e) cambia menos de un 0.1 %.",
    },
    gamma_adapt: {
      what: rate,
      small: "La articulación 1 apenas lo nota; I(e) de la 2 sube un quinto, la de la 3 la mitad.",
      large:
        "I(e) baja un décimo en la articulación 1 y cerca de la mitad en la 2 y la 3. Este esquema no tiene proyección: algunos " +
        "estimados oscilan hasta −8 y hasta 76 veces la verdad.",
    },
  },
  slotine_li: {
    k_s: {
      what: feedback,
      small:
        "Todas las articulaciones siguen de 3 a 4 veces peor, pero los errores mayores enseñan más: los estimados acaban más cerca " +
        "de la verdad.",
      large:
        "Todas siguen de 6 a 9 veces mejor, y los estimados casi no aprenden. Con cien veces el valor del artículo un paso de 1 ms " +
        "es demasiado grueso y la simulación diverge; con 0.1 ms no.",
    },
    lambda: {
      what: slope,
      small: "Los errores de seguimiento crecen de 4 a 6 veces.",
      large: "Los errores de seguimiento bajan de 9 a 10 veces, y los picos de par suben entre un décimo y un cuarto.",
    },
    gamma_adapt: {
      what: rate,
      small: "La articulación 1 sigue un décimo peor, la 2 un quinto, la 3 la mitad.",
      large: "I(e) baja a cerca de la mitad. Este esquema no tiene proyección: un estimado baja hasta −1.3.",
    },
  },
};
